#include "apps/signorini/chart/search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/signorini/chart/reference.hpp"
#include "apps/signorini/console.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::chart {
namespace {

/// A relative error of a sum that is nothing but rounding means nothing.
void refuse_cancelled(const nlohmann::json& report, const std::vector<double>& force) {
  constexpr double rounding = 1e-6;
  const auto pressures = quantity(report, "pressure"), areas = quantity(report, "area");
  if (!pressures || !areas) return;
  double pressed = 0, sum = 0;
  for (std::size_t k = 0; k < pressures->size(); ++k) pressed += (*pressures)[k] * (*areas)[k];
  for (const double f : force) sum = std::max(sum, std::abs(f));
  if (sum < rounding * pressed)
    throw Error(Exit::usage, fmt::format("--of force: what presses adds up to zero, so that a relative error says "
                                         "nothing; expected another quantity, such as {}",
                                         report["probes"].empty() ? "pressure or energy" : "pressure or a probe"));
}

/// What has no limit, as the largest pressure where an edge touches, is not found by refinement.
void refuse_endless(const std::string& of, const std::vector<double>& errors) {
  constexpr std::size_t meshes = 3;
  constexpr double much = 0.8;  // (a singularity of order 1/2 leaves a third)
  if (errors.size() <= meshes + 1 || errors.back() < much * errors[errors.size() - 1 - meshes]) return;
  throw Error(
      Exit::not_converged,
      fmt::format("the error of the {} is about {:.1e} on {} finer and finer meshes, so that it seems to have no "
                  "limit{}; expected another quantity",
                  of, errors.back(), meshes + 1,
                  of == "pressure" ? ": where an edge or a corner touches the largest pressure grows for ever" : ""));
}

/// Of one solve with these keys.
std::vector<double> value_of(const std::filesystem::path& file, std::vector<std::string> overrides,
                             const std::vector<std::string>& keys, const std::string& of) {
  overrides.insert(overrides.end(), keys.begin(), keys.end());
  const Console quiet(true);
  Driver driver(read_scene(file, overrides), quiet);
  const Report& report = driver.solve();
  if (!report.converged())
    throw Error(Exit::not_converged, fmt::format("with {}: {}", fmt::join(keys, " "), report.reason()));
  const nlohmann::json found = to_json(report);
  auto value = quantity(found, of);
  if (!value) throw Error(Exit::input, fmt::format("with {}: the result has no {}", fmt::join(keys, " "), of));
  if (of == "force") refuse_cancelled(found, *value);
  return *value;
}

}  // namespace

void check_quantity(const Scene& scene, const std::string& of) {
  std::vector<std::string> known{"energy"};
  if (!scene.obstacles.empty()) known.insert(known.end(), {"force", "pressure", "area"});
  for (const auto& probe : scene.probes) known.push_back("probe " + probe.name);
  if (std::ranges::find(known, of) == known.end())
    throw Error(Exit::usage, fmt::format("--of: found '{}', expected one of {}{}", of, fmt::join(known, " | "),
                                         did_you_mean(of, known)));
}

Found search(const std::filesystem::path& file, const std::vector<std::string>& overrides, const std::string& of,
             double accuracy, const std::function<void(const std::string&)>& say) {
  const Scene scene = read_scene(file, overrides);
  check_quantity(scene, of);
  const std::vector<Setting> all = settings(scene);
  const Setting &quadratic = all[0], &linear = all[1];
  say(fmt::format("{}, {}", linear.name, linear.keys_of(0).back()));
  std::vector<std::vector<double>> values{value_of(file, overrides, linear.keys_of(0), of)};
  double error = infinity;
  std::vector<double> errors;
  for (std::size_t k = 0; k < quadratic.values.size(); ++k) {
    const std::vector<std::string> keys = quadratic.keys_of(k);
    say(fmt::format("{}, {}{}", quadratic.name, keys.back(), k > 0 ? fmt::format(": error about {:.1e}", error) : ""));
    values.push_back(value_of(file, overrides, keys, of));
    error = errors.emplace_back(error_left(of, values));
    if (k > 0 && error <= accuracy) return {keys, error};  // one difference says little
    refuse_endless(of, errors);
  }
  throw Error(Exit::not_converged,
              fmt::format("the error of the {} is {:.1e} on the finest mesh, expected {:g}", of, error, accuracy));
}

}  // namespace signorini::chart
