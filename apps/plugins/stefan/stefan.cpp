// Ice that melts, one phase (Stefan's problem). The unknown is what the temperature has summed up to, w = int theta dt,
// which makes the problem one with an obstacle (Duvaut, 1973): w >= 0, and where it is positive  c w_t = div grad w - L
// with the heat capacity c and the latent heat L. A step of implicit Euler's method adds phi(v) = c measure/(2 dt) (v -
// v_last)^2 + L measure v.
#include <iterator>

#include <signorini/sdk/functional_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/stepping.hpp>

using namespace signorini;

namespace {

// Data: c measure / dt, and L measure. In the first step the last values are zero, and so is w at the beginning.
struct Phi {
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const double l = *slot.last;
    return (*to - *from) * (slot.data[0] / 2 * ((*to - l) + (*from - l)) + slot.data[1]);
  }

  static double derivative(const Slot<1>& slot, double v) { return slot.data[0] * (v - *slot.last) + slot.data[1]; }

  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return derivative(slot, *at) * *step;
  }

  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    *y = block::clamp(*x + (*r - derivative(slot, *x)) / (*M + slot.data[0]), *slot.lower, *slot.upper);
  }

  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = derivative(slot, *x);
    *out.hessian = slot.data[0];
  }
};

class Stefan final : public FunctionalObstacle<1, Phi>, public Scaling, public Stepping {
 public:
  explicit Stefan(const Settings& settings) : settings_(settings) {}

  void begin(const LoadStep& step, Status&) noexcept override { length_ = step.to - step.from; }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 2}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      const auto value = [&](const char* name) { return settings_.value(name, 0, v.position, v.normal, status); };
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = 0;
      c.upper[0] = infinity;
      c.data[0] = value("capacity") * v.measure / (settings_.number("duration") * length_);
      c.data[1] = value("latent_heat") * v.measure;
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override {
    data[0] *= ratio;
    data[1] *= ratio;
  }

 private:
  const Settings& settings_;
  double length_ = 1;
};

constexpr OptionSpec options[] = {
    {"capacity", OptionType::field, "1", "[0, inf)", "heat per volume and temperature"},
    {"latent_heat", OptionType::field, "1", "[0, inf)", "heat per volume that melting takes"},
    {"duration", OptionType::number, "1", "(0, inf)", "time of all steps together"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle(
      {"stefan", "ice that melts", options, std::size(options), false, sdk::create<Stefan, 1>, nullptr, nullptr},
      status);
}

}  // namespace

SIGNORINI_PLUGIN("stefan", "1.0.0", "ice that melts", register_all, "BSD-3-Clause");
