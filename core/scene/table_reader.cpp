#include "core/scene/table_reader.hpp"

#include <fmt/format.h>

#include <cassert>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/input/range.hpp"
#include "core/input/values.hpp"
#include "core/scene/toml.hpp"

namespace signorini {
namespace {

// Whether this value is understood, but not available in this version.
bool is_later(const KeySpec& spec, const RawValue& raw) {
  const std::string_view later = spec.later;
  if (later.empty() || later == every_value) return !later.empty();
  if (const auto* text = std::get_if<std::string>(&raw.value))
    return spec.type == KeyType::text && Range(later).contains(std::string_view(*text));
  if (const auto* integer = std::get_if<std::int64_t>(&raw.value))
    return spec.type == KeyType::integer && Range(later).contains(static_cast<double>(*integer));
  if (const auto* flag = std::get_if<bool>(&raw.value)) return later == (*flag ? "true" : "false");
  return false;
}

}  // namespace

void check_folder(const std::filesystem::path& folder, const std::string& place) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    input_error(place, fmt::format("there is no folder {}", in_quotes(folder.string())));
}

std::string file_complaint(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return fmt::format("{} is a folder", in_quotes(file.string()));
  if (std::filesystem::is_regular_file(file, error)) return {};
  if (std::filesystem::exists(file, error))
    return fmt::format("{} is a pipe or a device, expected a regular file", in_quotes(file.string()));
  std::vector<std::string> neighbours;
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    neighbours.push_back(entry->path().filename().string());
  return fmt::format("there is no file {}{}", in_quotes(file.string()),
                     did_you_mean(file.filename().string(), neighbours));
}

void check_file(const std::filesystem::path& file, const std::string& place) {
  if (const std::string complaint = file_complaint(file); !complaint.empty()) input_error(place, complaint);
}

TableReader::TableReader(const RawTable& table, std::span<const KeySpec> keys, const std::filesystem::path& folder)
    : table_(table), keys_(keys), folder_(folder) {}

const ShapeSpec& TableReader::use_shape(std::span<const ShapeSpec> shapes) {
  shapes_ = shapes;
  const std::string name = text("shape");
  shape_ = find_shape(shapes, name);
  if (!shape_) {
    const std::vector<std::string> names = names_of(shapes);
    input_error(origin("shape"), fmt::format("unknown shape {}{} (shapes: {})", in_quotes(name),
                                             did_you_mean(name, names), fmt::join(names, ", ")));
  }
  return *shape_;
}

const KeySpec* TableReader::find_spec(std::string_view key) const {
  if (shape_)
    if (const KeySpec* found = find_key(shape_->keys, key)) return found;
  return find_key(keys_, key);
}

const KeySpec& TableReader::spec(std::string_view key) const {
  const KeySpec* found = find_spec(key);
  assert(found && "the reader asks for a key that is in no specification");
  return *found;
}

void TableReader::unknown_key(const std::string& key, const RawValue& raw) const {
  for (const ShapeSpec& other : shapes_)
    if (find_key(other.keys, key)) {
      if (!shape_)
        input_error(raw.origin,
                    fmt::format("'{}' is a key of shape '{}' and has no meaning without 'shape'", key, other.name));
      input_error(raw.origin, fmt::format("'{}' is no key of shape '{}', whose keys are {}", key, shape_->name,
                                          fmt::join(names_of(shape_->keys), ", ")));
    }
  std::vector<std::string> names = names_of(keys_);
  if (shape_)
    for (const std::string& name : names_of(shape_->keys)) names.push_back(name);
  input_error(raw.origin, fmt::format("unknown key {}{}", in_quotes(key), did_you_mean(key, names)));
}

void TableReader::check_keys() const {
  for (const auto& [key, raw] : table_.entries)
    if (!find_spec(key)) unknown_key(key, raw);
  check_later();
}

RawTable TableReader::check_known_keys() const {
  RawTable unknown{table_.origin, {}};
  for (const auto& entry : table_.entries)
    if (!find_spec(entry.first)) unknown.entries.push_back(entry);
  check_later();
  return unknown;
}

void TableReader::check_later() const {
  for (const auto& [key, raw] : table_.entries)
    if (const KeySpec* found = find_spec(key)) check_available(*found, raw);
}

void TableReader::check_available(const KeySpec& spec, const RawValue& raw) const {
  if (!is_later(spec, raw)) return;
  if (spec.later == every_value)
    input_error(raw.origin, fmt::format("the key '{}' is not available in this version", spec.name));
  const auto* text = std::get_if<std::string>(&raw.value);
  input_error(raw.origin, fmt::format("{} = {} is not available in this version{}", spec.name,
                                      text ? in_quotes(*text) : describe(raw),
                                      *spec.range ? fmt::format(" (available: {})", spec.range) : ""));
}

void TableReader::require(std::string_view key, std::string_view why) const {
  if (!given(key)) input_error(table_.origin, fmt::format("missing key '{}', required {}", key, why));
}

void TableReader::forbid(std::string_view key, std::string_view where) const {
  if (given(key)) input_error(origin(key), fmt::format("'{}' has no meaning {}", key, where));
}

RawValue TableReader::value(const KeySpec& spec) const {
  if (const RawValue* raw = table_.find(spec.name)) {
    check_available(spec, *raw);
    return *raw;
  }
  if (!spec.fallback || !*spec.fallback) {
    const std::string where =
        shape_ && find_key(shape_->keys, spec.name) ? fmt::format(" of shape '{}'", shape_->name) : "";
    input_error(table_.origin, fmt::format("missing key '{}'{}: {}", spec.name, where, spec.help));
  }
  const std::string origin = fmt::format("{}.{} (default)", table_.origin, spec.name);
  return parse_toml_value(spec.fallback, origin).value_or(RawValue{std::string(spec.fallback), origin});
}

bool TableReader::flag(std::string_view key) const { return to_flag(value(spec(key))); }
int TableReader::integer(std::string_view key) const {
  return static_cast<int>(to_integer(value(spec(key)), spec(key).range));
}
double TableReader::number(std::string_view key) const { return to_number(value(spec(key)), spec(key).range); }
std::string TableReader::text(std::string_view key) const { return to_text(value(spec(key)), spec(key).range); }
std::string TableReader::choice(std::string_view key) const { return to_choice(value(spec(key)), spec(key).range); }
std::vector<std::string> TableReader::texts(std::string_view key) const { return to_texts(value(spec(key))); }
Field TableReader::field(std::string_view key) const { return to_field(value(spec(key)), spec(key).range); }
std::vector<Field> TableReader::fields(std::string_view key) const {
  return to_fields(value(spec(key)), spec(key).range);
}
std::vector<double> TableReader::point(std::string_view key) const { return to_numbers(value(spec(key))); }

std::filesystem::path TableReader::file(std::string_view key) const {
  const std::filesystem::path path = folder_ / text(key);
  check_file(path, origin(key));
  return path;
}

std::vector<std::optional<Field>> TableReader::values(std::string_view key) const {
  const RawValue raw = value(spec(key));
  const auto* list = std::get_if<RawValue::List>(&raw.value);
  std::vector<std::optional<Field>> all;
  for (const RawValue& entry : list ? *list : RawValue::List{raw}) {
    const auto* word = std::get_if<std::string>(&entry.value);
    all.push_back(word && *word == "free" ? std::nullopt : std::optional<Field>(to_field(entry)));
  }
  return all;
}

std::vector<Field> TableReader::components(std::string_view key) const {
  const RawValue raw = value(spec(key));
  const auto* list = std::get_if<RawValue::List>(&raw.value);
  std::vector<Field> all;
  for (const RawValue& entry : list ? *list : RawValue::List{raw}) all.push_back(to_field(entry, spec(key).range));
  return all;
}

std::vector<Field> TableReader::totals(std::string_view key) const {
  if (!given(key)) return {};
  const RawValue raw = value(spec(key));
  const auto* list = std::get_if<RawValue::List>(&raw.value);
  std::vector<Field> all;
  for (const RawValue& entry : list ? *list : RawValue::List{raw}) all.push_back(to_field_of_t(entry));
  return all;
}

std::vector<std::vector<double>> TableReader::points(std::string_view key) const {
  std::vector<std::vector<double>> all;
  const RawValue raw = value(spec(key));
  for (const RawValue& entry : to_list(raw, "a list of points")) all.push_back(to_numbers(entry));
  return all;
}

std::vector<Index> TableReader::integers(std::string_view key) const {
  const std::vector<std::int64_t> all = to_integers(value(spec(key)), spec(key).range);
  return {all.begin(), all.end()};
}

std::vector<double> TableReader::ascending(std::string_view key) const {
  const RawValue raw = value(spec(key));
  const RawValue::List& list = to_list(raw, "a list of numbers");
  if (list.empty()) input_error(raw.origin, "the list is empty");
  std::vector<double> all;
  for (const RawValue& entry : list) {
    const double number = to_number(entry, spec(key).range);
    if (!all.empty() && !(number > all.back()))
      input_error(entry.origin,
                  fmt::format("expected a number above {}, the one before, found {}", all.back(), number));
    all.push_back(number);
  }
  return all;
}

/// One part, or where a table takes it the edge of two.
Selection TableReader::parts(const std::string& key) const {
  if (spec(key).type == KeyType::text) return {text(key), std::nullopt, origin(key)};
  const std::vector<std::string> names = texts(key);
  if (names.empty() || names.size() > 2)
    input_error(origin(key),
                fmt::format("expected one part, or two whose common edge is meant, found {}", names.size()));
  if (names.size() == 2 && names[0] == names[1])
    input_error(origin(key), fmt::format("'{}' stands twice, and two parts mean the edge that they have in common; "
                                         "expected two parts, or \"{}\" for its faces",
                                         names[0], names[0]));
  Selection selection{names[0], std::nullopt, origin(key)};
  if (names.size() == 2) selection.other = names[1];
  return selection;
}

std::optional<Selection> TableReader::selection(const std::string& prefix) const {
  const std::string on = prefix + "on", where = prefix + "where";
  if (given(on) && given(where))
    input_error(origin(where), fmt::format("both '{}' and '{}' are given, expected one of them", on, where));
  for (const std::string& key : {on, where})
    if (given("at") && find_spec("at") && given(key))
      input_error(origin("at"), fmt::format("both '{}' and 'at' are given, expected one of them", key));
  if (given("at") && find_spec("at")) return Selection{{}, {}, origin("at"), {}, point("at")};
  if (given(on)) return parts(on);
  if (given(where)) return Selection{std::nullopt, field(where), origin(where)};
  return std::nullopt;
}

const std::string& TableReader::origin(std::string_view key) const {
  const RawValue* raw = table_.find(key);
  return raw ? raw->origin : table_.origin;
}

Scene::Source TableReader::source() const {
  Scene::Source source{table_.origin, {}};
  for (const auto& [key, raw] : table_.entries) source.keys.emplace(key, raw.origin);
  return source;
}

}  // namespace signorini
