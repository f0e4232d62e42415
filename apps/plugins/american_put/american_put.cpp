// An American put: the right to sell a share at the price K at any time until the maturity. Its value V is no less than
// what selling brings, and elsewhere follows the equation of Black and Scholes. In x = log(S/K), and multiplied by
// p = exp((2r/s^2 - 1) x), that is  p V_t = (s^2/2 p V_x)_x - r p V  with t the time that is left. A step of implicit
// Euler's method is then phi(v) = c/2 (v - v_last)^2 + k/2 v^2, c = p measure / dt, k = r p measure, and v >= max(K -
// S, 0).
#include <cmath>
#include <iterator>

#include <signorini/sdk/functional_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/stepping.hpp>

using namespace signorini;

namespace {

// Data: c, k, the value before the first step, and whether that is the last one.
struct Phi {
  static double last(const Slot<1>& slot) { return slot.data[3] != 0 ? slot.data[2] : *slot.last; }

  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const double l = last(slot), c = slot.data[0], k = slot.data[1];
    return (*to - *from) / 2 * (c * ((*to - l) + (*from - l)) + k * (*to + *from));
  }

  static double derivative(const Slot<1>& slot, double v) { return slot.data[0] * (v - last(slot)) + slot.data[1] * v; }

  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return derivative(slot, *at) * *step;
  }

  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double stiffness = *M + slot.data[0] + slot.data[1];
    *y = block::clamp(*x + (*r - derivative(slot, *x)) / stiffness, *slot.lower, *slot.upper);
  }

  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = derivative(slot, *x);
    *out.hessian = slot.data[0] + slot.data[1];
  }
};

class AmericanPut final : public FunctionalObstacle<1, Phi>, public Scaling, public Stepping {
 public:
  explicit AmericanPut(const Settings& settings) : settings_(settings) {}

  void begin(const LoadStep& step, Status&) noexcept override {
    first_ = step.from == 0;
    length_ = step.to - step.from;
  }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 4}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    const double strike = settings_.number("strike"), rate = settings_.number("rate");
    const double volatility = settings_.number("volatility"), dt = settings_.number("maturity") * length_;
    for (std::size_t k = 0; k < count; ++k) {
      const double x = vertices[k].position[0], payoff = strike * std::fmax(-std::expm1(x), 0);
      const double weight = vertices[k].measure * std::exp((2 * rate / (volatility * volatility) - 1) * x);
      if (!std::isfinite(weight / dt))
        return status.fail(static_cast<int>(Exit::input),
                           "the price at a node is too large; x is its logarithm, over 'strike'");
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = payoff;
      c.upper[0] = infinity;
      const double numbers[] = {weight / dt, rate * weight, payoff, first_ ? 1.0 : 0.0};
      std::copy(std::begin(numbers), std::end(numbers), c.data);
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override {
    data[0] *= ratio;
    data[1] *= ratio;
  }

 private:
  const Settings& settings_;
  bool first_ = true;
  double length_ = 1;
};

constexpr OptionSpec options[] = {
    {"strike", OptionType::number, "100", "(0, inf)", "the price K at which the share may be sold"},
    {"rate", OptionType::number, "0.05", "[0, 1]", "interest r per year"},
    {"volatility", OptionType::number, "0.2", "(0, 10]", "s, per square root of a year"},
    {"maturity", OptionType::number, "1", "(0, inf)", "years until the right ends"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"american_put", "an option that may be exercised early", options, std::size(options), false,
                      sdk::create<AmericanPut, 1>, nullptr, nullptr},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("american_put", "1.0.0", "an option that may be exercised early", register_all, "BSD-3-Clause");
