// A foundation of springs side by side that presses and does not pull: phi(v) = k/2 p^2, where p is how deep the body
// is in it, and no less than zero.
#include <cmath>
#include <iterator>

#include <signorini/sdk/functional_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/rigid_contact.hpp>

using namespace signorini;

namespace {

// Component 0 is along the normal, which points into the body. Data: stiffness times measure, and the distance.
template <int B>
struct Phi {
  static double depth(const Slot<B>& slot, const double* v) { return -v[0] - slot.data[1]; }

  static double change(const Slot<B>& slot, const double* from, const double* to) {
    const double before = depth(slot, from), after = depth(slot, to);
    const double a = std::fmax(before, 0), b = std::fmax(after, 0);
    const double deeper = before > 0 && after > 0 ? from[0] - to[0] : b - a;  // without cancellation
    return slot.data[0] / 2 * deeper * (a + b);
  }

  static double slope(const Slot<B>& slot, const double* at, const double* step) {
    return -slot.data[0] * std::fmax(depth(slot, at), 0) * step[0];
  }

  // Without the springs; where the body would be in them, with them.
  static void minimise(const Slot<B>& slot, const double* M, const double* r, const double* x, double* y) {
    solve(slot, M, r, x, 0, y);
    if (depth(slot, y) > 0) solve(slot, M, r, x, slot.data[0], y);
  }

  static void linearise(const Slot<B>& slot, const double* x, const QuadraticModel<B>& out) {
    const double p = depth(slot, x);
    if (!(p > 0)) return;
    out.gradient[0] = -slot.data[0] * p;
    out.hessian[0] = slot.data[0];
  }

 private:
  // The minimiser with springs of stiffness k that also pull; components that are prescribed, or beyond a bound, lie on
  // it.
  static void solve(const Slot<B>& slot, const double* M, const double* r, const double* x, double k, double* y) {
    unsigned fixed = 0;
    for (int i = 0; i < B; ++i)
      if (slot.lower[i] == slot.upper[i]) fixed |= 1u << i;
    for (int pass = 0; pass <= B; ++pass) {
      double d[B] = {}, stiffness[B * B], force[B];
      std::copy_n(M, B * B, stiffness);
      stiffness[0] += k;
      for (int i = 0; i < B; ++i) {
        if (fixed >> i & 1u) d[i] = block::clamp(y_or(x, y, i, pass), slot.lower[i], slot.upper[i]) - x[i];
        force[i] = r[i] + (i == 0 ? k * depth(slot, x) : 0);
      }
      block::subtract_product<B>(stiffness, d, force);
      double free[B];
      block::solve<B>(stiffness, force, ~fixed, free);
      unsigned beyond = 0;
      for (int i = 0; i < B; ++i) {
        y[i] = fixed >> i & 1u ? x[i] + d[i] : x[i] + free[i];
        const double within = block::clamp(y[i], slot.lower[i], slot.upper[i]);
        if (within != y[i] && !(fixed >> i & 1u)) beyond |= 1u << i;
        y[i] = within;
      }
      if (!beyond) return;
      fixed |= beyond;
    }
  }
  static double y_or(const double* x, const double* y, int i, int pass) { return pass == 0 ? x[i] : y[i]; }
};

template <int B>
class Winkler final : public FunctionalObstacle<B, Phi<B>>, public Scaling {
 public:
  explicit Winkler(const Settings& settings) : settings_(settings), contact_(settings, "winkler") {}

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}, 2}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      LocalConstraint<B>& c = constraints[k];
      contact_.assemble(v, c, status);
      if (!status.ok()) return;
      c.data[0] = v.measure * settings_.value("stiffness", 0, v.position, v.normal, status);
      c.data[1] = -c.lower[0];  // the distance
      c.lower[0] = -infinity;   // which may be passed, at a price
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

 private:
  const Settings& settings_;
  RigidContact<B> contact_;
};

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    {"stiffness", OptionType::field, "1", "[0, inf)", "force per area and depth"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"winkler", "a foundation that presses and does not pull", options, std::size(options), true,
                      nullptr, sdk::create<Winkler<2>, 2>, sdk::create<Winkler<3>, 3>},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("winkler", "1.0.0", "a foundation that presses and does not pull", register_all, "BSD-3-Clause");
