// A gas of density u that spreads in a porous medium, u_t = div grad u^m: a step of implicit Euler's method. The
// unknown is v = u^m, whose equation is (v^(1/m) - u_last) / dt = div grad v. So at each node phi(v) = c (m/(m+1)
// |v|^((m+1)/m) - u_last v) with c = measure / dt, and v >= 0.
#include <cmath>
#include <iterator>

#include <signorini/sdk/functional_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/stepping.hpp>

using namespace signorini;

namespace {

// Data: c, m, the density before the first step, and whether that is the last one.
struct Phi {
  static double density(double v, double m) { return std::copysign(std::pow(std::fabs(v), 1 / m), v); }

  static double last(const Slot<1>& slot) {
    return slot.data[3] != 0 ? slot.data[2] : density(*slot.last, slot.data[1]);
  }

  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const double m = slot.data[1], p = (m + 1) / m, a = std::fabs(*from), b = std::fabs(*to);
    // b^p - a^p, without cancellation where they are near.
    const bool near = a > 0 && b > a / 2 && b < 2 * a;
    const double larger =
        near ? std::pow(a, p) * std::expm1(p * std::log1p((b - a) / a)) : std::pow(b, p) - std::pow(a, p);
    return slot.data[0] * (larger / p - last(slot) * (*to - *from));
  }

  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return slot.data[0] * (density(*at, slot.data[1]) - last(slot)) * *step;
  }

  // The density s at the minimiser is the root of M s^m + c s = q, which is convex: by Newton's method from above.
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double c = slot.data[0], m = slot.data[1], q = *M * *x + *r + c * last(slot), size = std::fabs(q);
    double s = c > 0 ? size / c : infinity;
    if (*M > 0) s = std::fmin(s, std::pow(size / *M, 1 / m));
    for (int k = 0; k < 100 && s > 0; ++k) {
      const double power = *M * std::pow(s, m - 1), next = s - (power * s + c * s - size) / (m * power + c);
      const bool close = !(next < s * (1 - 1e-15));
      s = next;
      if (close) break;
    }
    *y = block::clamp(std::copysign(std::pow(s, m), q), *slot.lower, *slot.upper);
  }

  // At zero the second derivative is infinite: the component rests.
  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    const double m = slot.data[1], s = density(*x, m);
    if (*x == 0) {
      *out.critical |= 1;
      *out.lower = *out.upper = 0;
      return;
    }
    *out.gradient = slot.data[0] * (s - last(slot));
    *out.hessian = slot.data[0] * s / (m * *x);
  }
};

class PorousMedium final : public FunctionalObstacle<1, Phi>, public Scaling, public Stepping {
 public:
  explicit PorousMedium(const Settings& settings) : settings_(settings) {}

  void begin(const LoadStep& step, Status&) noexcept override {
    first_ = step.from == 0;
    length_ = step.to - step.from;
  }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 4}; }

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
      const double numbers[] = {v.measure / (settings_.number("duration") * length_), settings_.number("exponent"),
                                value("start"), first_ ? 1.0 : 0.0};
      if (status.ok() && numbers[2] < 0) status.fail(static_cast<int>(Exit::input), "'start' is negative");
      std::copy(std::begin(numbers), std::end(numbers), c.data);
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

 private:
  const Settings& settings_;
  bool first_ = true;
  double length_ = 1;
};

constexpr OptionSpec options[] = {
    {"exponent", OptionType::number, "2", "[1.1, 3]", "m of u_t = div grad u^m"},
    {"start", OptionType::field, "0", "", "density u before the first step"},
    {"duration", OptionType::number, "1", "(0, inf)", "time of all steps together"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"porous_medium", "a gas that spreads in a porous medium", options, std::size(options), false,
                      sdk::create<PorousMedium, 1>, nullptr, nullptr},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("porous_medium", "1.0.0", "a gas that spreads in a porous medium", register_all, "BSD-3-Clause");
