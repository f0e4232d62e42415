#include "core/scene/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/scene/specs.hpp"
#include "core/scene/toml.hpp"

namespace signorini {
namespace {

class Override {
 public:
  Override(RawDocument& document, const std::string& assignment)
      : document_(document), place_("--set " + clipped(assignment)) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) fail("expected KEY=VALUE");
    split(assignment.substr(0, equals));
    const std::string text = assignment.substr(equals + 1);
    const std::optional<RawValue> value = parse_toml_value(text, place_);
    if (!value && text.starts_with('['))
      fail(fmt::format("found {}, expected a list as [0, -0.05]: values between brackets, with commas between them",
                       in_quotes(text)));
    value_ = value.value_or(RawValue{text, place_});
  }

  void apply() {
    if (find_key(top_keys(), path_[0])) return set(document_.top, 0);
    const TableSpec* spec = find_table(path_[0]);
    if (!spec) fail(fmt::format("unknown table {}{}", in_quotes(path_[0]), did_you_mean(path_[0], first_names())));
    const std::size_t key = spec->listed ? 2 : 1;
    if (path_.size() <= key) fail(fmt::format("expected {}{}.KEY=VALUE", spec->name, spec->listed ? ".INDEX" : ""));
    RawTable& table = spec->listed ? listed(*spec) : single(*spec);
    check_key(*spec, path_[key]);
    set(table, key);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { input_error(place_, message); }

  static std::string clipped(const std::string& text) {
    const std::string line = in_quotes(text);
    return line.substr(1, line.size() - 2);
  }

  void split(const std::string& path) {
    for (std::size_t begin = 0; begin <= path.size();) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      std::string part = path.substr(begin, end - begin);
      part.erase(0, std::min(part.find_first_not_of(' '), part.size()));
      part.erase(part.find_last_not_of(' ') + 1);
      if (part.empty()) fail("expected KEY=VALUE, with parts of KEY separated by single dots");
      path_.push_back(std::move(part));
      begin = end + 1;
    }
  }

  std::size_t index(const std::string& part, std::size_t count, const std::string& of) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size())
      fail(fmt::format("expected an index after '{}', found {}", of, in_quotes(part)));
    if (value >= count) fail(fmt::format("index {} is out of range: '{}' has {}, counted from 0", value, of, count));
    return value;
  }

  std::vector<std::string> first_names() const {
    std::vector<std::string> names = names_of(top_keys());
    for (const TableSpec& table : table_specs()) names.push_back(table.name);
    return names;
  }

  RawTables* find_tables(const TableSpec& spec) {
    const auto found = std::find_if(document_.tables.begin(), document_.tables.end(),
                                    [&](const RawTables& tables) { return tables.name == spec.name; });
    return found == document_.tables.end() ? nullptr : &*found;
  }

  RawTable& listed(const TableSpec& spec) {
    RawTables* found = find_tables(spec);
    const std::size_t k = index(path_[1], found ? found->tables.size() : 0, spec.name);
    return found->tables[k];
  }

  RawTable& single(const TableSpec& spec) {
    if (!find_tables(spec)) document_.tables.push_back({spec.name, false, {RawTable{spec.name, {}}}});
    return find_tables(spec)->tables.front();
  }

  // Keys of an obstacle may belong to its plugin, which checks them later.
  void check_key(const TableSpec& spec, const std::string& key) const {
    const std::vector<std::string> names = all_names(spec);
    if (std::string_view(spec.name) != "obstacle" && std::find(names.begin(), names.end(), key) == names.end())
      fail(fmt::format("unknown key {} in '{}'{}", in_quotes(key), spec.name, did_you_mean(key, names)));
  }

  void set(RawTable& table, std::size_t key) {
    RawValue* target = table.find(path_[key]);
    if (!target) target = &table.entries.emplace_back(path_[key], RawValue{}).second;
    std::string name = path_[key];
    for (std::size_t k = key + 1; k < path_.size(); name += "." + path_[k++]) {
      auto* list = std::get_if<RawValue::List>(&target->value);
      if (!list) fail(fmt::format("'{}' is no list", name));
      target = &(*list)[index(path_[k], list->size(), name)];
    }
    *target = value_;
  }

  RawDocument& document_;
  std::string place_;
  std::vector<std::string> path_;
  RawValue value_;
};

}  // namespace

void apply_override(RawDocument& document, const std::string& assignment) { Override(document, assignment).apply(); }

}  // namespace signorini
