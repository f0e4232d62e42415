#include "core/scene/toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/scene/check_toml.hpp"

namespace signorini {
namespace {

/// Composes where a node stands: by its line in a file, or all in one place.
class Places {
 public:
  Places(std::string name, bool is_file) : name_(std::move(name)), is_file_(is_file) {}
  std::string of(const toml::node& node, const std::string& path) const {
    return is_file_ ? fmt::format("{}:{}: {}", name_, node.source().begin.line, path) : name_;
  }

 private:
  std::string name_;
  bool is_file_;
};

RawValue to_raw(const toml::node& node, const Places& places, const std::string& path) {
  RawValue raw{{}, places.of(node, path)};
  if (const auto* flag = node.as_boolean()) {
    raw.value = flag->get();
  } else if (const auto* integer = node.as_integer()) {
    raw.value = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    if (!std::isfinite(number->get())) input_error(raw.origin, "expected a finite number, found inf or nan");
    raw.value = number->get();
  } else if (const auto* text = node.as_string()) {
    raw.value = text->get();
  } else if (const auto* array = node.as_array()) {
    RawValue::List list;
    for (const toml::node& entry : *array)
      list.push_back(to_raw(entry, places, fmt::format("{}[{}]", path, list.size())));
    raw.value = std::move(list);
  } else {
    input_error(raw.origin, node.is_table() ? "a table cannot stand here" : "a date or time cannot stand here");
  }
  return raw;
}

std::string shown(const toml::key& key) {
  const std::string_view name = key.str();
  const bool bare = !name.empty() && name.size() < 60 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return bare ? std::string(name) : in_quotes(name);
}

RawTable to_raw_table(const toml::table& table, const Places& places, const std::string& path) {
  RawTable raw{places.of(table, path), {}};
  for (const auto& [key, node] : table)
    raw.entries.emplace_back(key.str(), to_raw(node, places, fmt::format("{}.{}", path, shown(key))));
  return raw;
}

RawTables to_raw_tables(const toml::key& key, const toml::array& array, const Places& places) {
  RawTables tables{std::string(key.str()), true, {}};
  for (const toml::node& entry : array)
    tables.tables.push_back(
        to_raw_table(*entry.as_table(), places, fmt::format("{}.{}", shown(key), tables.tables.size())));
  return tables;
}

RawDocument to_document(const toml::table& root, const Places& places, const std::string& name) {
  RawDocument document{{name, {}}, {}};
  for (const auto& [key, node] : root) {
    if (const toml::table* table = node.as_table())
      document.tables.push_back({std::string(key.str()), false, {to_raw_table(*table, places, shown(key))}});
    else if (node.is_array_of_tables())
      document.tables.push_back(to_raw_tables(key, *node.as_array(), places));
    else
      document.top.entries.emplace_back(key.str(), to_raw(node, places, shown(key)));
  }
  return document;
}

toml::table parse(std::string_view text, const std::string& name) {
  check_toml(text, name);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    input_error(fmt::format("{}:{}:{}", name, at.line, at.column), error.description());
  }
}

}  // namespace

RawDocument parse_toml(std::string_view text, const std::string& name) {
  return to_document(parse(text, name), Places(name, true), name);
}

std::optional<RawValue> parse_toml_value(const std::string& text, const std::string& origin) {
  toml::table table;
  try {
    table = parse("value = " + text, origin);
  } catch (const Error&) {
    return std::nullopt;
  }
  if (table.size() != 1 || !table.contains("value")) return std::nullopt;
  return to_raw(*table.get("value"), Places(origin, false), "");
}

}  // namespace signorini
