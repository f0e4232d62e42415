/// Bounds on a scalar unknown: lower(x) <= u(x) <= upper(x), of which one may be missing.
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
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = has_lower_ ? value("lower", vertices[k], status) : -infinity;
      c.upper[0] = has_upper_ ? value("upper", vertices[k], status) : infinity;
      if (status.ok() && c.lower[0] > c.upper[0]) infeasible(vertices[k], c, status);
    }
  }

 private:
  double value(const char* name, const SurfaceVertex& vertex, Status& status) const noexcept {
    return settings_.value(name, 0, vertex.position, vertex.normal, status);
  }

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

SIGNORINI_PLUGIN("scalar", "1.0.0", "bounds on a scalar unknown", signorini::register_all);
