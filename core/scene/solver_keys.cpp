#include "core/scene/solver_keys.hpp"

#include <fmt/format.h>

#include <deque>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/scene/table_reader.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {
namespace {

using Solver = Scene::Solver;

constexpr OptionRow<Solver> of_scenes[] = {
    {"algebraic", &Solver::algebraic, "",
     "below a coarsest mesh with more than 1000 vertices, levels chosen by the matrix", false,
     "See docs/theory/amg.md."},
    {"hierarchy", &Solver::hierarchy, "auto | meshes | matrix",
     "what the levels below the finest mesh come from: the coarser meshes, or the matrix of the finest one alone; "
     "auto: the meshes, but the matrix where cells are stretched and algebraic levels are allowed",
     false, "See docs/theory/stretched_and_slender.md."},
    {"bodies", &Solver::bodies, "jumps | dirichlet-neumann",
     "how bodies that touch each other are solved: as one problem whose unknowns are jumps between them, or in turns, "
     "the slave on the surface of the master, which feels its forces",
     false, "See docs/bodies.md."},
    {"start", &Solver::start, "nested | zero", "nested: from the solution on the next coarser mesh", false,
     "Below the coarsest mesh it comes from the next algebraic level. Coarser meshes that have a start themselves get "
     "one cycle for scalar problems, at most five for elastic bodies."},
    {"estimate", &Solver::estimate, "false | true | auto | cheap | recovery | ...",
     "bounds of the energy error of the mesh, in the report and in a line at the end; cheap: in less time and less "
     "sharp for elastic bodies; auto: cheap for elastic bodies in space; recovery, or another one of `signorini list "
     "estimators`: no bounds, but about how large the error is",
     false, "See docs/how_good.md."},
};

// As TOML: 1e-8, not 1e-08.
std::string written(double value) {
  std::string text = fmt::format("{}", value);
  if (const std::size_t zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}
// Pages of docs/ that a text names become links.
std::string linked(std::string text) {
  constexpr std::string_view folder = "docs/", ending = ".md";
  for (std::size_t from = text.find(folder); from != std::string::npos; from = text.find(folder, from)) {
    const std::size_t end = text.find(ending, from);
    if (end == std::string::npos) break;
    const std::size_t name = from + folder.size(), length = end + ending.size() - name;
    const std::string link = fmt::format("[{0}]({0})", text.substr(name, length));
    text.replace(from, folder.size() + length, link);
    from += link.size();
  }
  return text;
}

std::string written(bool value) { return value ? "true" : "false"; }
std::string written(int value) { return fmt::format("{}", value); }
std::string written(const std::string& value) { return value; }

constexpr KeyType type_of(bool) { return KeyType::boolean; }
constexpr KeyType type_of(int) { return KeyType::integer; }
constexpr KeyType type_of(double) { return KeyType::number; }
KeyType type_of(const std::string&) { return KeyType::text; }
/// A text that may be written as a flag, too.
bool is_flag_or_word(const char* range) { return std::string_view(range).find("true |") != std::string_view::npos; }

/// The keys with their defaults, which no table of constants holds.
struct Keys {
  std::deque<std::string> defaults;
  std::vector<KeySpec> all;

  template <class Options>
  void add(std::span<const OptionRow<Options>> rows) {
    const Options fresh;
    for (const OptionRow<Options>& row : rows)
      std::visit(
          [&](auto member) {
            defaults.push_back(written(fresh.*member));
            const KeyType type = is_flag_or_word(row.range) ? KeyType::choice : type_of(fresh.*member);
            all.push_back({row.name, type, defaults.back().c_str(), row.range, "", row.help});
          },
          row.member);
  }
};

const Keys& keys() {
  static const Keys made = [] {
    Keys all;
    all.add(option_table());
    all.add(std::span<const OptionRow<Solver>>(of_scenes));
    return all;
  }();
  return made;
}

void read(const TableReader& reader, const char* key, bool& value) { value = reader.flag(key); }
void read(const TableReader& reader, const char* key, int& value) { value = reader.integer(key); }
void read(const TableReader& reader, const char* key, double& value) { value = reader.number(key); }
void read(const TableReader& reader, const char* key, std::string& value) {
  const auto spec =
      std::ranges::find_if(solver_keys(), [&](const KeySpec& one) { return std::string_view(one.name) == key; });
  value = spec->type == KeyType::choice ? reader.choice(key) : reader.text(key);
}

template <class Options>
void read_all(const TableReader& reader, std::span<const OptionRow<Options>> rows, Options& options) {
  for (const OptionRow<Options>& row : rows)
    std::visit([&](auto member) { read(reader, row.name, options.*member); }, row.member);
}

}  // namespace

std::span<const KeySpec> solver_keys() { return keys().all; }

std::span<const char* const> solver_keys_of_scenes() {
  static const auto names = [] {
    std::vector<const char*> all;
    for (const OptionRow<Solver>& row : of_scenes) all.push_back(row.name);
    return all;
  }();
  return names;
}

const char* more_about(std::string_view key) {
  for (const auto& row : option_table())
    if (row.name == key) return row.more;
  for (const auto& row : of_scenes)
    if (row.name == key) return row.more;
  return "";
}

std::string solver_options_page() {
  std::string text = "| key | default | range | meaning |\n| --- | --- | --- | --- |\n";
  const auto add = [&](const KeySpec& key, const char* more) {
    const bool word = key.type == KeyType::text;
    std::string range = key.range;
    for (std::size_t at = 0; (at = range.find('|', at)) != std::string::npos; at += 2) range.insert(at, 1, '\\');
    text += fmt::format("| `{}` | {}{}{} | {} | {}.{}{} |\n", key.name, word ? "\"" : "", key.fallback,
                        word ? "\"" : "", range, key.help, *more ? " " : "", linked(more));
  };
  auto key = solver_keys().begin();
  for (const auto& row : option_table()) add(*key++, row.more);
  for (const auto& row : of_scenes) add(*key++, row.more);
  return text;
}

std::string Scene::estimator() const {
  const std::string& asked = solver.estimate;
  if (asked == "false" && !refine.adaptive) return {};
  if (asked == "false" && !refine.is_for_energy()) return "recovery";
  return asked == "false" || asked == "true" || asked == "auto" || asked == "cheap" ? "certificate" : asked;
}

Scene::Solver read_solver(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, solver_keys(), folder);
  reader.check_keys();
  Scene::Solver solver;
  read_all<SolverOptions>(reader, option_table(), solver);
  read_all<Solver>(reader, of_scenes, solver);
  solver.source = reader.source();
  if (solver.pre + solver.post == 0) input_error(reader.origin("post"), "'pre' and 'post' are both 0: nothing smooths");
  return solver;
}

}  // namespace signorini
