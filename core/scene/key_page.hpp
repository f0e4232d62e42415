#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/specs.hpp"

namespace signorini {

/// A key of a scene, and where it stands.
struct KeyPlace {
  const TableSpec* table = nullptr;  ///< null: outside any
  const ShapeSpec* shape = nullptr;  ///< of a body or an obstacle, where the key is one of its own
  const KeySpec* key = nullptr;

  /// "solver.tolerance", "body.ball.radius", "title".
  std::string path() const;
};

/// All keys, in the order of the reference.
const std::vector<KeyPlace>& key_places();

/// Those that are meant by "body.ball.radius", "body.radius" or "radius".
std::vector<KeyPlace> keys_named(std::string_view name);

/// A few lines of TOML that have the key.
std::string key_example(const KeyPlace& place);

/// The same with another key in a table, such as one of a plugin: `lines` after its head.
std::string table_example(const TableSpec& table, std::string_view lines);

/// A key on a page of its own, as text whose lines are as long as they are.
std::string key_page(const KeyPlace& place);

/// What a table is for, with its keys.
std::string table_page(const TableSpec& table);

/// Each line two spaces further to the right.
std::string indented(std::string_view text);

/// The choices that a help text explains, "auto: ..." begin lines of their own.
std::string with_choices_on_lines(std::string_view help, std::string_view range);

}  // namespace signorini
