#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace signorini {

/// A value as it stands in a scene, not yet checked against any specification.
struct RawValue {
  using List = std::vector<RawValue>;

  std::variant<bool, std::int64_t, double, std::string, List> value;
  std::string origin;  ///< "scene.toml:12: fix.0.value[1]" or "--set refine.uniform=3"
};

/// The keys of one table, in the order of the file.
struct RawTable {
  std::string origin;  ///< "scene.toml:12: fix.0"
  std::vector<std::pair<std::string, RawValue>> entries;

  const RawValue* find(std::string_view key) const;
  RawValue* find(std::string_view key);
};

/// A kind of table with all of its occurrences.
struct RawTables {
  std::string name;
  bool listed = false;  ///< written as `[[name]]`; else there is exactly one
  std::vector<RawTable> tables;
};

/// A whole scene: keys outside any table, and the tables by name.
struct RawDocument {
  RawTable top;
  std::vector<RawTables> tables;

  const std::vector<RawTable>& of(std::string_view name) const;  ///< empty when there are none
};

}  // namespace signorini
