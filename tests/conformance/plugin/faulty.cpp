// One obstacle type with each fault that the kit has to find: the option `fault` chooses it. Without one it has none.
// For scalar unknowns it is a functional, in the plane contact with friction, in space a box.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string>
#include <thread>

#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "core/sdk/plugin.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini::test {
namespace {

std::string chosen;  // by whoever was constructed last
bool has(const char* fault) { return chosen == fault; }

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// phi(v) = s |v - c| + k/2 (v - c)^2. Data: s, k, c.
struct Law {
  static double s(const Slot<1>& slot) { return slot.data[0]; }
  static double k(const Slot<1>& slot) { return has("concave") ? -slot.data[1] : slot.data[1]; }
  static double c(const Slot<1>& slot) { return slot.data[2]; }

  static double one_sided(const Slot<1>& slot, double from, double to, double sign) {
    return (to - from) * (sign * s(slot) + 0.5 * k(slot) * ((from - c(slot)) + (to - c(slot))));
  }
  static double right_change(const Slot<1>& slot, double from, double to) {
    if (from >= c(slot) && to >= c(slot)) return one_sided(slot, from, to, 1);
    if (from <= c(slot) && to <= c(slot)) return one_sided(slot, from, to, -1);
    return right_change(slot, from, c(slot)) + right_change(slot, c(slot), to);
  }
  static double phi(const Slot<1>& slot, double v) {
    const double d = v - c(slot);
    return s(slot) * std::fabs(d) + 0.5 * k(slot) * d * d;
  }

  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const double right = right_change(slot, *from, *to), d = *to - *from;
    if (has("change_crashes")) std::abort();
    while (has("change_hangs")) usleep(1000);
    if (has("change_of_nothing")) return right + 1e-3 * s(slot);
    if (has("change_nan")) return d > 0 ? nothing : right;
    if (has("change_not_antisymmetric")) return right + 0.1 * s(slot) * std::fabs(d);
    if (has("change_not_additive")) return right + s(slot) * d * d * d;
    if (has("change_with_cancellation")) return phi(slot, *to) - phi(slot, *from);
    if (has("change_doubled")) return 2 * right;
    if (has("number_not_announced")) return right + slot.data[5];
    return right;
  }

  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    const double d = *at - c(slot), bend = k(slot) * d * *step;
    if (has("slope_of_one_side") && d == 0) return s(slot) * *step;
    const bool kink = d == 0 || (has("slope_with_absolute_tolerance") && std::fabs(d) < 1e-9);
    const double right = bend + (kink ? s(slot) * std::fabs(*step) : d > 0 ? s(slot) * *step : -s(slot) * *step);
    if (has("slope_of_wrong_sign")) return -right;
    if (has("slope_not_homogeneous")) return right * std::fabs(*step);
    if (has("slope_without_kink")) return bend;
    return right;
  }

  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double stiffness = *M + k(slot), force = *r + *M * *x + k(slot) * c(slot);
    const double right = (force - s(slot)) / stiffness, left = (force + s(slot)) / stiffness;
    *y = right > c(slot) ? right : left < c(slot) ? left : c(slot);
    if (has("minimise_misses_kink") && *y == c(slot)) *y = right;
    if (has("minimise_nears_kink") && *y == c(slot)) *y = c(slot) + 1e-7 * (*x - c(slot));
    if (has("minimise_forgets_functional")) *y = *x + *r / *M;
    if (has("minimise_half_way")) *y = 0.5 * (*x + *y);
    if (has("minimise_with_absolute_tolerance") && std::fabs(*y - *x) < 1e-9) *y = *x;
    if (has("minimise_beyond_bounds")) return;
    if (has("minimise_moves_prescribed") && *slot.lower == *slot.upper) return;
    *y = block::clamp(*y, *slot.lower, *slot.upper);
    if (has("minimise_idle")) *y = *x;
    if (has("minimise_nan")) *y = nothing;
  }

  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    const double d = *x - c(slot);
    const bool kink = (d == 0 && s(slot) > 0 && !has("kink_missed")) || has("kink_everywhere");
    if (kink) {
      *out.critical |= 1;
      if (has("kink_moves")) return;
      *out.lower = *out.upper = 0;
      return;
    }
    *out.gradient = (d > 0 ? s(slot) : -s(slot)) + k(slot) * d;
    *out.hessian = k(slot);
    if (has("gradient_zero")) *out.gradient = 0;
    if (has("gradient_of_wrong_sign")) *out.gradient *= -1;
    if (has("hessian_doubled")) *out.hessian *= 2;
    if (has("hessian_forgotten")) *out.hessian = 0;
    if (has("hessian_negative")) *out.hessian *= -1;
    if (has("hessian_nan")) *out.hessian = nothing;
    if (has("correction_bounds_off")) *out.lower = 1e-3;
  }
};

class Scalar final : public FunctionalObstacle<1, Law>, public Scaling {
 public:
  explicit Scalar(const Settings& settings) : settings_(settings) { chosen = settings.text("fault"); }
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 2}}, 3}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    for (std::size_t i = 0; i < count && status.ok(); ++i) {
      const SurfaceVertex& v = vertices[i];
      LocalConstraint<1>& c = constraints[i];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = -0.3;
      c.upper[0] = infinity;
      c.data[0] = v.measure * settings_.value("gap", 0, v.position, v.normal, status);
      c.data[1] = has("number_forgets_measure") ? 2 : 2 * v.measure;
      if (has("number_too_many")) c.data[3] = 1;
    }
  }
  const Scaling* scaling() const noexcept override { return has("scaling_missing") ? nullptr : this; }
  void scale(double ratio, double* data) const noexcept override {
    data[0] *= ratio;
    if (!has("scaling_of_half")) data[1] *= ratio;
  }

 private:
  const Settings& settings_;
};

class Plane final : public FunctionalObstacle<2, GivenFriction<2>, GivenFrictionSolver<2>, GivenFrictionModel<2>>,
                    public Scaling,
                    public Renewal<2>,
                    public Friction {
 public:
  explicit Plane(const Settings& settings) : settings_(settings), contact_(settings, "faulty") {
    chosen = settings.text("fault");
    if (has("asks_for_wrong_name")) (void)settings.has("gapp");
    if (has("asks_as_wrong_type")) (void)settings.number("gap");
    if (has("needs_something")) throw Error(Exit::input, "something is missing");
    if (has("throws")) throw 7;
    double gap = 0;
    if (has("throws_at_zero") && settings.constant("gap", gap) && gap == 0) throw std::runtime_error("gap");
  }
  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{has("direction_without_name") ? "" : "normal", 2, 1}, {"tangential", 1, 1}}, 1};
  }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<2>* constraints,
                Status& status) const noexcept override {
    static std::atomic<int> calls = 0;
    static std::atomic<int> inside = 0;
    for (std::size_t i = 0; i < count && status.ok(); ++i) {
      const SurfaceVertex& v = vertices[i];
      LocalConstraint<2>& c = constraints[i];
      contact_.assemble(v, c, status);
      if (!status.ok()) return;
      c.data[0] = v.measure * settings_.value("gap", 0, v.position, v.normal, status);
      if (has("asks_later_as_wrong_type")) (void)settings_.integer("gap");
      if (has("direction_long")) c.direction[0][0] *= 2;
      if (has("direction_nan")) c.direction[0][0] = nothing;
      if (has("direction_fixed")) c.direction[0][0] = 0, c.direction[0][1] = 1;
      if (has("directions_too_many")) c.directions = 3;
      if (has("directions_dependent") || has("bounds_not_set")) {
        c.directions = 2;
        c.direction[1][0] = -c.direction[0][has("bounds_not_set") ? 1 : 0];
        c.direction[1][1] = has("bounds_not_set") ? c.direction[0][0] : -c.direction[0][1];
      }
      if (has("directions_dependent")) c.lower[1] = -1, c.upper[1] = 1;
      if (has("bounds_crossed")) c.upper[0] = c.lower[0] - 1;
      if (has("bounds_nan")) c.lower[0] = nothing;
      if (has("bound_far_off_nan") && std::fabs(v.position[0]) > 1e6) c.lower[0] = nothing;
      if (has("bound_at_height")) c.lower[0] = -v.position[1];
      if (has("number_nan")) c.data[0] = nothing;
      if (has("depends_on_order")) c.lower[0] -= 1e-3 * static_cast<double>(i);
      if (has("depends_on_calls")) c.lower[0] -= 1e-3 * ++calls;
      if (has("minds_threads") && i == 0 && count > 1) {
        if (++inside > 1) c.lower[0] -= 1;                            // another thread is here, too
        std::this_thread::sleep_for(std::chrono::microseconds(200));  // once a call: a sleep can last a millisecond
        --inside;
      }
      if (has("status_of_plugin")) status.fail(0, "it cannot");
    }
    if (has("writes_beyond")) constraints[count].directions = 0;
    if (has("reads_beyond") && vertices[count].measure < 0) status.fail(2, "it read");
    if (has("crashes_alone") && count == 1) std::abort();
  }
  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }
  const Renewal<2>* renewal() const noexcept override { return this; }
  void renew(const LevelView<2>& level, Index first, Index last, const double*, double* data) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    for (Index slot = from; slot < to; ++slot) {
      data[slot * level.width] = level.data[slot * level.width] * (has("renew_nan") ? nothing : 1);
      if (has("renew_writes_beyond")) data[slot * level.width + 1] = 0;
    }
  }
  const Friction* friction() const noexcept override { return this; }
  FrictionLaw law(const double* data) const noexcept override { return {0, has("law_of_another") ? 2 * *data : *data}; }

 private:
  const Settings& settings_;
  RigidContact<2> contact_;
};

/// Cuts off what is beyond the bounds, which is no minimiser where components are coupled.
struct CutOff {
  static void correct(const double* M, const double* inverse, const double* r, const double* lower, const double* upper,
                      double* d) {
    if (!has("box_cut_off")) return BoxMinimiser<3>::correct(M, inverse, r, lower, upper, d);
    block::product<3>(inverse, r, d);
    for (int k = 0; k < 3; ++k) d[k] = block::clamp(d[k], lower[k], upper[k]);
  }
};

class Space final : public BoxObstacle<3, CutOff> {
 public:
  explicit Space(const Settings& settings) : contact_(settings, "faulty") { chosen = settings.text("fault"); }
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", 3, 1}}}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<3>* constraints,
                Status& status) const noexcept override {
    for (std::size_t i = 0; i < count && status.ok(); ++i) contact_.assemble(vertices[i], constraints[i], status);
  }
  void sweep(const LevelView<3>& level, Index first, Index last, Order order) const noexcept override {
    BoxObstacle<3, CutOff>::sweep(level, first, last, order);
    for (Index slot = 0; slot < level.slots; ++slot) {
      const Index p = level.constrained[slot];
      double& x = level.x[3 * p];
      if (p < first || p >= last) continue;
      if (has("box_rounds_beyond") && x == level.lower[3 * slot]) x -= 1e-12 * std::fabs(x);
      if (has("box_nan")) x = nothing;
    }
  }
  void distance(const LevelView<3>& level, Index first, Index last, double* lower, double* upper,
                Flags* critical) const noexcept override {
    BoxObstacle<3, CutOff>::distance(level, first, last, lower, upper, critical);
    for (Index slot = 0; slot < level.slots; ++slot) {
      if (has("distance_without_flags")) critical[slot] = 0;
      if (has("distance_too_far")) lower[3 * slot] *= 2;
    }
  }

 private:
  RigidContact<3> contact_;
};

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    {"fault", OptionType::text, "none", "", "what it does wrong"},
    {"gap", OptionType::field, "0.1", "[0, inf)", "a number"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"faulty", "for a test", options, std::size(options), true, sdk::create<Scalar, 1>,
                      sdk::create<Plane, 2>, sdk::create<Space, 3>},
                     status);
}

}  // namespace
}  // namespace signorini::test

SIGNORINI_PLUGIN("faulty", "0.1.0", "with each fault that the kit has to find", signorini::test::register_all);
