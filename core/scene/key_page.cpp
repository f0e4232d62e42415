#include "core/scene/key_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input/range.hpp"
#include "core/scene/examples.hpp"
#include "core/scene/solver_keys.hpp"

namespace signorini {
namespace {

std::vector<KeyPlace> all_places() {
  std::vector<KeyPlace> all;
  for (const KeySpec& key : top_keys()) all.push_back({nullptr, nullptr, &key});
  for (const TableSpec& table : table_specs()) {
    for (const KeySpec& key : table.keys) all.push_back({&table, nullptr, &key});
    for (const ShapeSpec& shape : shapes_of(table))
      for (const KeySpec& key : shape.keys) all.push_back({&table, &shape, &key});
  }
  return all;
}

std::string head_of(const TableSpec& table) {
  return fmt::format(fmt::runtime(table.listed ? "[[{}]]" : "[{}]"), table.name);
}

/// What a line of TOML sets.
std::string_view key_of(std::string_view line) {
  const std::size_t equals = line.find(" = ");
  return equals == std::string_view::npos ? std::string_view() : line.substr(0, equals);
}

template <class Visit>
void each_line(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// The first line that sets the key in a text, beside the head of the table where there is one.
std::string line_in(std::string_view text, std::string_view key, std::string_view head = {}) {
  std::string found;
  bool within = head.empty();
  each_line(text, [&](std::string_view line) {
    if (!head.empty() && line.starts_with('[')) within = line == head;
    if (found.empty() && within && key_of(line) == key) found = line;
  });
  return found;
}

/// Values of keys that stand in no example of the reference.
struct Sample {
  const char* path;
  const char* value;
};
constexpr Sample samples[] = {{"fix.where", "\"z > 0.5 && x < 1\""},
                              {"load.on", "\"top\""},
                              {"body.rectangle.from", "[0, 0]"},
                              {"body.rectangle.to", "[2, 1]"},
                              {"body.rectangle.cells", "[8, 4]"},
                              {"body.disk.center", "[0, 0]"},
                              {"body.half_disk.center", "[0, 0]"},
                              {"obstacle.where", "\"z < -0.5\""},
                              {"obstacle.other", "\"base\""},
                              {"obstacle.other_on", "\"top\""},
                              {"obstacle.other_where", "\"z > 0.5\""},
                              {"obstacle.plane.point", "[0, 0, \"-1 + 0.01*t\"]"},
                              {"obstacle.expression.distance", "\"sqrt(x^2 + y^2 + z^2) - 1\""},
                              {"obstacle.surface.file", "\"anvil.stl\""},
                              {"body.solid.file", "\"part.off\""},
                              {"material.diffusion", "2.5"},
                              {"material.body", "\"part\""},
                              {"solver.threads", "4"}};

const char* sample_of(KeyType type) {
  switch (type) {
    case KeyType::fields:
    case KeyType::totals:
    case KeyType::moment:
      return "[0, 0, 1]";
    case KeyType::point:
      return "[0, 0, 0]";
    case KeyType::points:
      return "[[0, 0], [1, 0], [0, 1]]";
    case KeyType::text:
      return "\"name\"";
    default:
      return "1";
  }
}

/// Of the values in a range, or of a default, those that TOML wants in quotes.
bool is_word(const KeySpec& key, std::string_view value) {
  const bool number = !value.empty() && value.find_first_not_of("0123456789") == std::string_view::npos;
  return value.front() != '"' && (key.type == KeyType::text || (key.type == KeyType::choice && !number));
}

/// Another choice than the default, where there is one.
std::string value_unlike_default(const KeyPlace& place) {
  const KeySpec& key = *place.key;
  const std::string path = place.path(), fallback = key.fallback ? key.fallback : "";
  if (const auto* found = std::ranges::find_if(samples, [&](const Sample& s) { return s.path == path; });
      found != std::end(samples))
    return found->value;
  if (key.type == KeyType::boolean && key.later.empty()) return fallback == "true" ? "false" : "true";
  std::string value = fallback;
  const Range range(key.range);
  for (const std::string& choice : range.choices())
    if (value == fallback && choice != fallback) value = choice;
  if (value.empty()) return sample_of(key.type);
  return is_word(key, value) ? '"' + value + '"' : value;
}

std::string example_line(const KeyPlace& place) {
  const std::string name = place.key->name;
  if (place.table) {
    const TableText& text = table_text(place.table->name);
    // Shapes share names: what an example says of one of them is none of another.
    if (std::string line = place.shape ? "" : line_in(text.details, name, head_of(*place.table)); !line.empty())
      return line;
  }
  return name + " = " + value_unlike_default(place);
}

bool is_in(std::string_view example, const KeyPlace& place) {
  if (line_in(example, place.key->name).empty()) return false;
  return !place.shape || line_in(example, "shape").ends_with(fmt::format("\"{}\"", place.shape->name));
}

std::string default_text(const KeySpec& key) {
  if (!key.fallback) return "required";
  return *key.fallback ? key.fallback : "none";
}

std::string where_it_stands(const KeyPlace& place) {
  if (!place.table) return "outside any table of a scene";
  const std::string table = fmt::format("a key of {}", head_of(*place.table));
  return place.shape ? fmt::format("{} where shape = \"{}\": {}", table, place.shape->name, place.shape->help) : table;
}

/// As --set takes it: tables that may stand several times by number.
std::string override_of(const KeyPlace& place, std::string_view line) {
  std::string value(line.substr(line.find(" = ") + 3));
  value = value.substr(0, value.find("  "));
  std::erase(value, '"');
  const bool plain = value.find_first_of(" []\"*<>&|()") == std::string::npos;
  const std::string table = place.table ? fmt::format("{}{}.", place.table->name, place.table->listed ? ".0" : "") : "";
  return plain ? fmt::format("signorini solve SCENE.toml --set {}{}={}", table, place.key->name, value) : "";
}

}  // namespace

std::string KeyPlace::path() const {
  return fmt::format("{}{}{}{}{}", table ? table->name : "", table ? "." : "", shape ? shape->name : "",
                     shape ? "." : "", key->name);
}

const std::vector<KeyPlace>& key_places() {
  static const std::vector<KeyPlace> all = all_places();
  return all;
}

std::vector<KeyPlace> keys_named(std::string_view name) {
  std::vector<KeyPlace> found;
  for (const KeyPlace& place : key_places()) {
    const std::string without_shape = KeyPlace{place.table, nullptr, place.key}.path();
    if (name == place.path() || name == without_shape || name == place.key->name) found.push_back(place);
  }
  return found;
}

std::string indented(std::string_view text) {
  std::string out;
  each_line(text, [&](std::string_view line) { out += fmt::format("  {}\n", line); });
  return out;
}

std::string table_example(const TableSpec& table, std::string_view lines) {
  return fmt::format("{}\n{}\n", head_of(table), lines);
}

std::string key_example(const KeyPlace& place) {
  const std::string_view example = table_text(place.table ? place.table->name : "").example;
  if (is_in(example, place)) return std::string(example) + '\n';
  const std::string line = example_line(place);
  if (!place.table) return line + '\n';
  return table_example(*place.table,
                       place.shape ? fmt::format("shape = \"{}\"\n{}", place.shape->name, line) : std::string(line));
}

std::string key_page(const KeyPlace& place) {
  const KeySpec& key = *place.key;
  std::string text = fmt::format("{}: {}\n\n", place.path(), where_it_stands(place));
  text += indented(with_choices_on_lines(key.help, key.range));
  text += fmt::format("\n  {:<9} {}\n", "type", type_name(key.type));
  if (*key.range) text += fmt::format("  {:<9} {}\n", "range", key.range);
  text += fmt::format("  {:<9} {}\n", "default", default_text(key));
  if (key.later == every_value) return text + "\nNot yet available.\n";
  if (!key.later.empty()) text += fmt::format("\nNot yet available: {}.\n", key.later);
  const std::string example = key_example(place);
  text += "\nExample:\n" + indented(example);
  if (const std::string set = override_of(place, line_in(example, key.name)); !set.empty())
    text += fmt::format("\nOr for one run:\n  {}\n", set);
  if (place.table && std::string_view(place.table->name) == "solver")
    if (const std::string_view more = more_about(key.name); !more.empty()) text += fmt::format("\nFurther: {}\n", more);
  return text;
}

std::string table_page(const TableSpec& table) {
  std::string text = fmt::format("{}: {}\n\n", head_of(table), table.help);
  for (const KeyPlace& place : key_places())
    if (place.table == &table && !place.shape) text += fmt::format("  {:<14}  {}\n", place.key->name, place.key->help);
  for (const ShapeSpec& shape : shapes_of(table)) {
    text += fmt::format("\n  shape = \"{}\": {}\n", shape.name, shape.help);
    for (const KeySpec& key : shape.keys) text += fmt::format("  {:<14}  {}\n", key.name, key.help);
  }
  const std::string_view example = table_text(table.name).example;
  if (!example.empty()) text += "\nExample:\n" + indented(example);
  return text;
}

std::string with_choices_on_lines(std::string_view help, std::string_view range) {
  std::string text(help);
  const Range known(range);
  for (const std::string& choice : known.choices())
    for (const char* before : {"; ", ". "})
      if (const std::size_t at = text.find(before + choice + ": "); at != std::string::npos) text[at + 1] = '\n';
  return text;
}

}  // namespace signorini
