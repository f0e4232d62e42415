/// Bounds on a scalar unknown: lower(x) <= u(x) <= upper(x), of which one may be missing.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

class Scalar final : public BoxObstacle<1> {
 public:
  explicit Scalar(const Settings& settings)
      : settings_(settings), has_lower_(settings.has("lower")), has_upper_(settings.has("upper")) {
    if (!has_lower_ && !has_upper_) throw Error(Exit::input, "a scalar obstacle needs 'lower' or 'upper'");
  }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 2}}}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    constexpr std::size_t some = 64;
    double lower[some], upper[some];
    std::fill_n(lower, some, -infinity);
    std::fill_n(upper, some, infinity);
    for (std::size_t first = 0; first < count && status.ok(); first += some) {
      const std::size_t here = std::min(some, count - first);
      if (has_lower_) settings_.values("lower", vertices + first, here, lower, status);
      if (has_upper_) settings_.values("upper", vertices + first, here, upper, status);
      for (std::size_t k = 0; k < here && status.ok(); ++k) {
        LocalConstraint<1>& c = constraints[first + k];
        c.directions = 1;
        c.direction[0][0] = 1;
        c.lower[0] = lower[k];
        c.upper[0] = upper[k];
        if (c.lower[0] > c.upper[0]) infeasible(vertices[first + k], c, status);
      }
    }
  }

 private:
  static void infeasible(const SurfaceVertex& vertex, const LocalConstraint<1>& c, Status& status) noexcept {
    char message[256];
    std::snprintf(message, sizeof message, "no solution: at (%g, %g, %g) 'lower' is %.10g and 'upper' is %.10g",
                  vertex.position[0], vertex.position[1], vertex.position[2], c.lower[0], c.upper[0]);
    status.fail(static_cast<int>(Exit::no_solution), message);
  }

  const Settings& settings_;
  const bool has_lower_, has_upper_;
};

constexpr OptionSpec options[] = {
    {"lower", OptionType::field, "", "", "lower bound on the unknown; none when missing"},
    {"upper", OptionType::field, "", "", "upper bound on the unknown; none when missing"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"scalar", "bounds on a scalar unknown", options, std::size(options), false,
                      sdk::create<Scalar, 1>, nullptr, nullptr},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("scalar", "1.0.0", "bounds on a scalar unknown", signorini::register_all, "BSD-3-Clause");
