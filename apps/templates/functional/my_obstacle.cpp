// A scalar unknown that rests at a place: phi(v) = force |v - place|, at every node.
#include <cmath>
#include <iterator>

#include <signorini/sdk/functional_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>

using namespace signorini;

namespace {

// Data: the force at the node, and the place.
struct Phi {
  // Without cancellation: on one side of the place the difference of the arguments is taken, not that of phi.
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const double g = slot.data[0], c = slot.data[1];
    if (*from >= c && *to >= c) return g * (*to - *from);
    if (*from <= c && *to <= c) return g * (*from - *to);
    return g * (std::fabs(*to - c) - std::fabs(*from - c));
  }

  // At the place itself it leads up to both sides.
  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    const double g = slot.data[0], c = slot.data[1];
    return *at > c ? g * *step : *at < c ? -g * *step : g * std::fabs(*step);
  }

  // The minimiser y of 1/2 M (y - x)^2 - r (y - x) + phi(y): right of the place, left of it, or the place exactly.
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double g = slot.data[0], c = slot.data[1];
    const double right = *x + (*r - g) / *M, left = *x + (*r + g) / *M;
    *y = block::clamp(right > c ? right : left < c ? left : c, *slot.lower, *slot.upper);
  }

  // The piece that x is on, a line; at the place there is none, and the component rests.
  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    const double g = slot.data[0], c = slot.data[1];
    if (*x == c && g > 0) {
      *out.critical |= 1;
      *out.lower = *out.upper = 0;
    } else {
      *out.gradient = *x > c ? g : -g;
    }
  }
};

class MyObstacle final : public FunctionalObstacle<1, Phi>, public Scaling {
 public:
  explicit MyObstacle(const Settings& settings) : settings_(settings) {}

  // One direction, the unknown itself, and two numbers.
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 2}; }

  // Several threads may be in here at a time.
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = -infinity;
      c.upper[0] = infinity;
      c.data[0] = v.measure * settings_.value("force", 0, v.position, v.normal, status);  // an integral
      c.data[1] = settings_.value("place", 0, v.position, v.normal, status);
    }
  }

  // At a node that stands for several: integrals grow, places stay.
  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

 private:
  const Settings& settings_;  // outlives the obstacle
};

constexpr OptionSpec options[] = {
    {"force", OptionType::field, "0.1", "[0, inf)", "what holds the unknown at its place, per measure"},
    {"place", OptionType::field, "0", "", "where it rests"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"my_obstacle", "a scalar unknown that rests at a place", options, std::size(options), false,
                      sdk::create<MyObstacle, 1>, nullptr, nullptr},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("my_obstacle", "0.1.0", "a scalar unknown that rests at a place", register_all);
