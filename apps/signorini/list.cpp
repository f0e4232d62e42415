#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "amg/registration.hpp"
#include "apps/signorini/commands.hpp"
#include "core/component/companion.hpp"
#include "core/component/libraries.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/scene/solver_keys.hpp"
#include "driver/components.hpp"

namespace signorini {
namespace {

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

/// Of an option of a component, or a key of a scene.
template <class Spec>
void print_option(const Spec& option) {
  std::string type = type_name(option.type);
  if (*option.range) type += fmt::format(" in {}", option.range);
  if (*option.fallback) type += fmt::format(", default {}", option.fallback);
  fmt::print("      {:<14} {} ({})\n", option.name, option.help, type);
}

std::string told(const std::string& licence) { return licence.empty() ? "the library does not say" : licence; }

void print_entry(const Entry& entry) {
  fmt::print("  {:<16} {}\n", entry.id, entry.help);
  for (const OptionSpec& option : entry.options) print_option(option);
  fmt::print("      from {}{}{}\n", entry.file, entry.version.empty() ? "" : ", version ", entry.version);
  if (entry.kind == "obstacle") fmt::print("      licence: {}\n", told(licence_of(entry.file)));
  if (!entry.optimised) fmt::print("      compiled without optimisation: solves take several times as long\n");
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
  fmt::print("{}\n", kind.plural);
  bool none = true;
  for (const Entry& entry : all.entries)
    if (entry.kind == kind.kind) {
      print_entry(entry);
      none = false;
    }
  if (none) fmt::print("  none in this version\n");
}
constexpr const char* solver = "solver";  // no component: what puts the components together
constexpr const char* libraries = "libraries";

/// What the program consists of beside plugins, and under which licences.
void print_libraries() {
  fmt::print("{}\n", libraries);
  const Library core = loaded_libraries().front();
  fmt::print("  {:<16} everything else\n      from {}\n      licence: {}\n", "core", core.file, core.licence);
  for (const Companion& companion : companions) {
    const std::string file = path_of(companion).string(), why = why_missing(companion);
    std::error_code ignored;
    fmt::print("  {:<16} {}, with {}, loaded where it is needed\n", companion.name, companion.what, companion.of);
    if (std::filesystem::exists(file, ignored))
      fmt::print("      from {}\n      licence: {}\n", file, companion.licence);
    else
      fmt::print("      not there: {}\n", why.empty() ? file : why);
  }
}

void print_solver() {
  fmt::print("{}\n  {:<16} {}\n", solver, "[solver]", "keys of the scene's table, --set solver.KEY=VALUE");
  for (const KeySpec& key : solver_keys()) print_option(key);
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
  Registry registry = solver_components();
  PluginLoader loader(registry);
  Catalogue all = catalogue(registry, loader);
  std::ranges::copy(coarsenings(), std::back_inserter(all.entries));
  if (kinds.empty() || kinds == solver) print_solver();
  for (const Kind& kind : kinds_table)
    if (kinds.empty() || kinds == kind.plural) print_kind(kind, all);
  if (kinds.empty() || kinds == libraries) print_libraries();
  if (!kinds.empty() && kinds != "obstacles") return;
  for (const auto& rejected : all.rejected) fmt::print("rejected: {}\n  {}\n", rejected.file, rejected.reason);
}

}  // namespace signorini
