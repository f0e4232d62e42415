#pragma once
#include <string_view>

namespace signorini {

/// What the reference says about a table beside its keys.
struct TableText {
  const char* table;
  const char* example;  ///< TOML; those of all tables after one another are a scene
  const char* details;  ///< after the keys, as Markdown; "" for none
};

/// Every table has one; that of the keys outside any table is called "".
const TableText& table_text(std::string_view table);

}  // namespace signorini
