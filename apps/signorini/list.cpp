#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string_view>

#include "amg/registration.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/option_text.hpp"
#include "apps/signorini/text.hpp"
#include "core/component/companion.hpp"
#include "core/component/libraries.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/scene/key_page.hpp"
#include "core/scene/solver_keys.hpp"
#include "driver/components.hpp"

namespace signorini {

const char* type_name(OptionType type) {
  switch (type) {
    case OptionType::boolean:
      return "true or false";
    case OptionType::integer:
      return "integer";
    case OptionType::number:
      return "number";
    case OptionType::text:
      return "text";
    case OptionType::field:
      return "number or expression";
    case OptionType::vector:
      return "list of numbers or expressions";
  }
  return "";
}

namespace {

/// Of an option of a component, or a key of a scene: where its choices are explained they have a line each.
template <class Spec>
void print_option(const Spec& option) {
  std::string text = with_choices_on_lines(option.help, option.range);
  text += fmt::format("{}({})", text.find('\n') == std::string::npos ? ' ' : '\n', option_kind(option));
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text.insert(at + 1, 22, ' ');
  say("      {:<14}  {}\n", option.name, text);
}

/// Of the keys of [solver] those that are changed most often.
constexpr std::string_view first_keys[] = {"tolerance", "max_iterations", "method", "threads",  "cycle",
                                           "pre",       "post",           "coarse", "smoother", "krylov"};

std::string told(const std::string& licence) { return licence.empty() ? "the library does not say" : licence; }

/// Whose paths are long, and differ in the last name: their folders are told once.
bool is_plugin(const Entry& entry) { return !entry.version.empty(); }

void print_entry(const Entry& entry) {
  say("  {:<16}  {}\n", entry.id, entry.help);
  for (const OptionSpec& option : entry.options) print_option(option);
  say("      from {}{}{}\n", is_plugin(entry) ? std::filesystem::path(entry.file).filename().string() : entry.file,
      entry.version.empty() ? "" : ", version ", entry.version);
  if (is_plugin(entry)) say("      licence: {}\n", told(licence_of(entry.file)));
  if (!entry.optimised) say("      compiled without optimisation: solves take several times as long\n");
}

struct Kind {
  const char* plural;
  const char* kind;
};
constexpr Kind kinds_table[] = {{"obstacles", "obstacle"},
                                {"smoothers", "smoother"},
                                {"transfers", "transfer"},
                                {"coarse", "coarse"},
                                {"linear", "linear"},
                                {"unsymmetric", "unsymmetric"},
                                {"amg", "amg"},
                                {"aggregates", "aggregates"},
                                {"estimators", "estimator"}};

void print_kind(const Kind& kind, const Catalogue& all) {
  say("{}\n", kind.plural);
  std::set<std::string> folders;
  bool none = true;
  for (const Entry& entry : all.entries)
    if (entry.kind == kind.kind) {
      print_entry(entry);
      if (is_plugin(entry)) folders.insert(std::filesystem::path(entry.file).parent_path().string());
      none = false;
    }
  if (none) say("  none in this version\n");
  for (const std::string& folder : folders) say("  in {}\n", folder);
}
constexpr const char* solver = "solver";  // no component: what puts the components together
constexpr const char* libraries = "libraries";

/// What the program consists of beside plugins, and under which licences.
void print_libraries() {
  say("{}\n", libraries);
  const Library core = loaded_libraries().front();
  say("  {:<16}  everything else\n      from {}\n      licence: {}\n", "core", core.file, core.licence);
  for (const Companion& companion : companions) {
    const std::string file = path_of(companion).string(), why = why_missing(companion);
    std::error_code ignored;
    say("  {:<16}  {}{}, loaded where it is needed\n", companion.name, companion.what,
        *companion.of ? fmt::format(", with {}", companion.of) : "");
    if (std::filesystem::exists(file, ignored))
      say("      from {}\n      licence: {}\n", file, companion.licence);
    else
      say("      not there: {}\n", why.empty() ? file : why);
  }
}

void print_solver() {
  say("{}\n  {:<16}  {}\n", solver, "[solver]",
      "keys of the scene's table, --set solver.KEY=VALUE; `signorini help KEY` has a page on each");
  for (const std::string_view name : first_keys) print_option(*find_key(solver_keys(), name));
  say("    and those that rarely need a change:\n");
  for (const KeySpec& key : solver_keys())
    if (std::ranges::find(first_keys, key.name) == std::end(first_keys)) print_option(key);
}
}  // namespace

const std::vector<std::string>& listable_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result{solver, libraries};
    for (const Kind& kind : kinds_table) result.emplace_back(kind.plural);
    return result;
  }();
  return names;
}

void list_command(const std::string& kinds) {
  Registry registry = all_components();
  PluginLoader loader(registry);
  Catalogue all = catalogue(registry, loader);
  std::ranges::copy(coarsenings(), std::back_inserter(all.entries));
  if (kinds.empty() || kinds == solver) print_solver();
  for (const Kind& kind : kinds_table)
    if (kinds.empty() || kinds == kind.plural) print_kind(kind, all);
  if (kinds.empty() || kinds == libraries) print_libraries();
  if (!kinds.empty() && kinds != "obstacles" && kinds != "estimators") return;
  for (const auto& rejected : all.rejected) say("rejected: {}\n  {}\n", rejected.file, rejected.reason);
}

}  // namespace signorini
