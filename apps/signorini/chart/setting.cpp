#include "apps/signorini/chart/setting.hpp"

#include <fmt/format.h>

namespace signorini::chart {
namespace {

std::vector<std::string> elements_of(const Scene& scene, int order) {
  std::vector<std::string> keys;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    keys.push_back(fmt::format("body.{}.order={}", body, order));
  return keys;
}

std::vector<std::string> with(std::vector<std::string> keys, const std::string& key) {
  keys.push_back(key);
  return keys;
}

}  // namespace

std::vector<std::string> Setting::keys_of(std::size_t k) const { return with(keys, finer + "=" + values[k]); }

std::vector<Setting> settings(const Scene& scene) {
  const std::vector<std::string> refined{"0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10"};
  const std::vector<std::string> tolerances{"1e-1", "3e-2", "1e-2", "3e-3", "1e-3", "3e-4", "1e-4", "3e-5", "1e-5"};
  const std::string uniform = "refine.uniform", all_over = "refine.adaptive=false";
  const auto linear = with(elements_of(scene, 1), all_over), quadratic = with(elements_of(scene, 2), all_over);
  return {
      {"quadratic elements", quadratic, uniform, refined},
      {"linear elements", linear, uniform, refined, true},
      {"linear, adaptive", with(with(elements_of(scene, 1), "refine.adaptive=true"), uniform + "=0"),
       "refine.tolerance", tolerances},
      {"quadratic, tolerance 1e-4", with(quadratic, "solver.tolerance=1e-4"), uniform, refined},
  };
}

}  // namespace signorini::chart
