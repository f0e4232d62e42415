#pragma once
#include <string>

#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"

namespace signorini::test {

/// A scene solved, the energy J(u_h) of its solution, and what the certificate says.
struct Estimated {
  double energy;
  Estimate estimate;

  /// J(v) of the function v that the bounds are of.
  double lifted() const { return energy + estimate.lifted; }
};

inline Estimated estimated(const std::string& scene, int refinements, const std::string& tolerance = "1e-10",
                           bool cheap = false) {
  Scene parsed = parse_scene(
      scene + "[solver]\ntolerance = " + tolerance + "\n[refine]\nuniform = " + std::to_string(refinements) + "\n",
      "test.toml", ".");
  for (Scene::Obstacle& obstacle : parsed.obstacles) obstacle.renew = false;  // bounds are of bodies as they are drawn
  Driver driver(std::move(parsed));
  driver.solve();
  return {driver.report().last().summary.energy, driver.visit(0, [&](const auto& run) { return run.estimate(cheap); })};
}

}  // namespace signorini::test
