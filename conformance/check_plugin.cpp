#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/kit.hpp"
#include "conformance/library.hpp"
#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"

namespace signorini::conformance {
namespace {

namespace fs = std::filesystem;

void check_file(const fs::path& file, Outcomes& outcomes) {
  const std::vector<std::string> symbols = exported_symbols(file);
  if (symbols == std::vector<std::string>{"signorini_plugin"})
    outcomes.pass("exports");
  else
    outcomes.fail("exports", fmt::format("it exports {}", fmt::join(symbols, ", ")),
                  "build it with signorini_plugin() of the CMake package");
}

void check_help(const Entry& entry, Outcomes& outcomes) {
  std::string silent;
  if (entry.help.empty()) silent = "the obstacle has none";
  for (const OptionSpec& option : entry.options)
    if (!*option.help) silent = fmt::format("option '{}' has none", option.name);
  silent.empty() ? outcomes.pass("help") : outcomes.fail("help", silent, fmt::format("obstacle '{}'", entry.id));
}

}  // namespace

Verdict check_plugin(const fs::path& library, const Options& options) {
  std::error_code ignored;
  if (!fs::is_regular_file(library, ignored))
    throw Error(Exit::input, fmt::format("{}: there is no such file; expected a plugin that is built, "
                                         "libsignorini_obstacle_ID.so",
                                         library.string()));
  const fs::path file = fs::absolute(library), folder = file.parent_path();
  Outcomes outcomes;
  Registry registry;
  const std::string id = id_in_name(file);
  try {
    PluginLoader(registry).load(file);
    outcomes.pass("loads");
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted) throw;
    outcomes.fail("loads", error.what(), file.string());
    return outcomes.verdict(id);
  }
  check_file(file, outcomes);
  std::vector<std::string> ids;
  for (const Entry& entry : registry.entries("obstacle")) ids.push_back(entry.id);
  if (id.empty() || !registry.has("obstacle", id)) {
    outcomes.fail("id", fmt::format("it provides {}", fmt::join(ids, ", ")), file.filename().string());
    return outcomes.verdict(id);
  }
  outcomes.pass("id");
  for (const std::string& other : ids)
    if (other != id)
      outcomes.note(
          fmt::format("it provides '{0}', too, which scenes find by the name libsignorini_obstacle_{0}.so "
                      "alone: check a link of that name",
                      other));
  check_help(registry.entry("obstacle", id), outcomes);
  const Subject subject(registry.obstacle(id), id, options.settings);
  std::vector<std::string> refused;
  int sizes = 0;
  const auto run = [&]<int B>() {
    if (!subject.has<B>()) return;
    ++sizes;
    if (std::string why = run_checks<B>(subject, folder, options, outcomes); !why.empty()) refused.push_back(why);
  };
  run.operator()<1>();
  run.operator()<2>();
  run.operator()<3>();
  if (static_cast<int>(refused.size()) == sizes) throw Error(Exit::input, refused.front());
  for (const std::string& why : refused) outcomes.note(fmt::format("not all sizes were checked, for it says: {}", why));
  return outcomes.verdict(id);
}

}  // namespace signorini::conformance
