#include "core/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/mesh/mirror.hpp"
#include "core/scene/override.hpp"
#include "core/scene/read_tables.hpp"
#include "core/scene/solver_keys.hpp"
#include "core/scene/table_reader.hpp"
#include "core/scene/toml.hpp"

namespace signorini {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;

// Every table is one that scenes have, and written as it should be; keys outside tables are known.
void check_tables(const RawDocument& document) {
  std::vector<std::string> names = names_of(top_keys());
  for (const TableSpec& table : table_specs()) names.push_back(table.name);
  for (const RawTables& found : document.tables) {
    const TableSpec* spec = find_table(found.name);
    const std::string& place = found.tables.front().origin;
    if (!spec)
      input_error(place, fmt::format("unknown table {}{}", in_quotes(found.name), did_you_mean(found.name, names)));
    if (spec->listed != found.listed)
      input_error(place, spec->listed ? fmt::format("this table is written [[{}]], not [{}]", spec->name, spec->name)
                                      : fmt::format("this table is written [{}], not [[{}]]", spec->name, spec->name));
  }
  for (const auto& [key, raw] : document.top.entries) {
    if (find_key(top_keys(), key)) continue;
    if (const TableSpec* spec = find_table(key))
      input_error(raw.origin,
                  fmt::format("expected a table, written {}", spec->listed ? "[[" + key + "]]" : "[" + key + "]"));
    input_error(raw.origin, fmt::format("unknown key {}{}", in_quotes(key), did_you_mean(key, names)));
  }
}

template <class Read>
auto read_all(const RawDocument& document, const char* name, const std::filesystem::path& folder, Read read) {
  std::vector<decltype(read(RawTable{}, folder))> all;
  for (const RawTable& table : document.of(name)) all.push_back(read(table, folder));
  return all;
}

// A table of which there is at most one; all defaults when it is missing.
const RawTable& single(const RawDocument& document, const char* name, RawTable& empty) {
  const std::vector<RawTable>& found = document.of(name);
  return found.empty() ? (empty = RawTable{name, {}}) : found.front();
}

Scene::Steps read_steps(const TableReader& table) {
  Scene::Steps steps{{}, table.integer("halvings"), table.source()};
  const int count = table.integer("count");
  if (!table.given("at")) {
    for (int k = 1; k <= count; ++k) steps.at.push_back(static_cast<double>(k) / count);
    return steps;
  }
  if (table.given("count"))
    input_error(
        table.origin("at"),
        fmt::format("both 'at' and 'count' ({}) are given, expected one of them: give steps.at another list, or "
                    "remove it",
                    table.origin("count")));
  steps.at = table.ascending("at");
  if (steps.at.back() != 1)
    input_error(table.origin("at"), fmt::format("expected 1 as the last value, found {}", steps.at.back()));
  return steps;
}

Scene::Symmetry read_symmetry(const TableReader& table) {
  Scene::Symmetry symmetry{{}, table.source()};
  for (int axis = 0; axis < 3; ++axis)
    if (const std::string_view key = axis_name(axis); table.given(key))
      symmetry.planes.push_back({axis, table.number(key)});
  return symmetry;
}

void read_settings(const RawDocument& document, const std::filesystem::path& folder, Scene& scene) {
  RawTable empty;
  scene.solver = read_solver(single(document, "solver", empty), folder);
  const auto reader = [&](const char* name) {
    TableReader table(single(document, name, empty), find_table(name)->keys, folder);
    table.check_keys();
    return table;
  };
  const TableReader refine = reader("refine");
  scene.refine = {refine.integer("uniform"),      refine.source(),
                  refine.flag("adaptive"),        refine.number("tolerance"),
                  refine.integer("max_unknowns"), refine.integer("max_steps"),
                  refine.number("max_seconds"),   refine.text("goal")};
  scene.symmetry = read_symmetry(reader("symmetry"));
  scene.steps = read_steps(reader("steps"));
  const TableReader output = reader("output");
  scene.output = {output.flag("vtu"), output.flag("pictures"), output.flag("convergence")};
  const TableReader plugins = reader("plugins");
  for (const std::string& path : plugins.texts("path")) {
    scene.plugin_path.push_back(folder / path);
    check_folder(scene.plugin_path.back(), plugins.origin("path"));
  }
}

std::string read_file(const std::filesystem::path& file) {
  if (const std::string complaint = file_complaint(file); !complaint.empty()) throw Error(Exit::input, complaint);
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  char chunk[65536];
  while (stream.read(chunk, sizeof chunk) || stream.gcount() > 0) {
    text.append(chunk, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest_file)
      input_error(file.string(), fmt::format("larger than {} bytes: this is no scene", largest_file));
  }
  if (!stream.eof()) input_error(file.string(), "the file cannot be read");
  return text;
}

}  // namespace

const std::string& Scene::Source::of(std::string_view key) const {
  const auto found = keys.find(key);
  return found == keys.end() ? table : found->second;
}

const Scene::Body& Scene::body(std::string_view body_name) const {
  return *std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == body_name; });
}

std::string Scene::Refine::goal_probe() const {
  constexpr std::string_view kind = "probe ";
  return goal.starts_with(kind) ? goal.substr(kind.size()) : std::string();
}

bool Scene::looks_for_pairs(const Body& body) const {
  if (!contact || body.equation != Equation::elasticity) return false;
  return contact->between.empty() || std::ranges::find(contact->between, body.name) != contact->between.end();
}

Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  std::span<const std::string> overrides) {
  RawDocument document = parse_toml(text, name);
  check_tables(document);
  for (const std::string& given : overrides) apply_override(document, given);
  Scene scene;
  scene.file = name;
  scene.name = std::filesystem::path(name).stem().string();
  const TableReader top(document.top, top_keys(), folder);
  scene.title = top.text("title");
  scene.bodies = read_all(document, "body", folder, read_body);
  scene.materials = read_all(document, "material", folder, read_material);
  scene.fixes = read_all(document, "fix", folder, read_fix);
  scene.loads = read_all(document, "load", folder, read_load);
  scene.springs = read_all(document, "spring", folder, read_spring);
  scene.rigids = read_all(document, "rigid", folder, read_rigid);
  for (const Scene::Body& body : scene.bodies)
    if (scene.dimension == 0) scene.dimension = dimension_of(body);
  scene.obstacles = read_all(document, "obstacle", folder, read_obstacle);
  for (const RawTable& table : document.of("contact")) scene.contact = read_contact(table, folder);
  scene.probes = read_all(document, "probe", folder, read_probe);
  read_settings(document, folder, scene);
  choose_elements(scene);
  check_scene(scene, name);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_file(file), file.string(), file.parent_path(), overrides);
}

}  // namespace signorini
