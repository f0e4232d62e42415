#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/signorini/commands.hpp"
#include "apps/signorini/text.hpp"
#include "conformance/check.hpp"
#include "core/base/error.hpp"

namespace signorini {
namespace {

using conformance::Check;
using conformance::Failure;
using conformance::Verdict;

nlohmann::json json_of(const Check& check) {
  return {{"id", check.id}, {"expected", check.expected}, {"page", check.page}};
}

nlohmann::json json_of(const Verdict& verdict, const std::filesystem::path& file) {
  nlohmann::json passed = nlohmann::json::array(), failed = nlohmann::json::array();
  for (const Check& check : verdict.passed) passed.push_back(json_of(check));
  for (const Failure& failure : verdict.failures) {
    nlohmann::json one = json_of(failure.check);
    one["found"] = failure.found;
    one["example"] = failure.example;
    failed.push_back(std::move(one));
  }
  return {{"plugin", verdict.type}, {"file", file.string()}, {"conforms", verdict.conforms()},
          {"passed", passed},       {"failed", failed},      {"notes", verdict.notes}};
}

}  // namespace

void plugin_check_command(const PluginCheckArguments& arguments) {
  const Verdict verdict = conformance::check_plugin(arguments.file, {arguments.settings, !arguments.no_solves});
  if (arguments.json)
    fmt::print("{}\n", json_of(verdict, arguments.file).dump(2));
  else
    print_fitted(conformance::text_of(verdict));
  if (!verdict.conforms())
    throw Error(Exit::plugin, fmt::format("{}: the plugin does not do what is expected of it: {} of {} checks failed",
                                          arguments.file.string(), verdict.failures.size(),
                                          verdict.failures.size() + verdict.passed.size()));
}

}  // namespace signorini
