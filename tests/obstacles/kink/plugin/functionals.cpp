// Small functionals, each with one thing that the kernel has to get right. They use the SDK alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "core/sdk/functional_obstacle.hpp"
#include "core/sdk/plugin.hpp"
#include "core/sdk/stepping.hpp"

namespace signorini::test {
namespace {

/// A functional acts along these directions, and nothing bounds them.
template <int B>
void unbounded(LocalConstraint<B>& c, int directions) {
  c.directions = directions;
  std::fill_n(c.lower, directions, -infinity);
  std::fill_n(c.upper, directions, infinity);
}

/// g |v| at every vertex, without any number of its own.
struct Cost {
  static constexpr double g = 0.01;
  static double size(const double* v) { return std::fabs(*v); }
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double force = *r + *M * *x;
    *y = force > g ? (force - g) / *M : force < -g ? (force + g) / *M : 0;
    *y = *y < *slot.lower ? *slot.lower : *y > *slot.upper ? *slot.upper : *y;
  }
  static double change(const Slot<1>&, const double* from, const double* to) { return g * (size(to) - size(from)); }
  static double slope(const Slot<1>&, const double* at, const double* step) {
    return *at == 0 ? g * size(step) : *at > 0 ? g * *step : -g * *step;
  }
  static void linearise(const Slot<1>&, const double* x, const QuadraticModel<1>& out) {
    if (*x == 0) {
      *out.critical |= 1;
      *out.lower = *out.upper = 0;
    } else {
      *out.gradient = *x > 0 ? g : -g;
    }
  }
};

class CostObstacle : public FunctionalObstacle<1, Cost> {
 public:
  explicit CostObstacle(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 0}; }
  void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<1>* constraints,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      unbounded(constraints[k], 1);
      constraints[k].direction[0][0] = 1;
    }
  }
};

/// k h v^2 / 2, h being the largest |v| there was until the end of the last load step: 0 in the first one. Data: h, k.
struct Hardening {
  static double stiffness(const Slot<1>& slot) { return slot.data[1] * slot.before[0]; }
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    *y = (*r + *M * *x) / (*M + stiffness(slot));
  }
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    return 0.5 * stiffness(slot) * (*to - *from) * (*to + *from);
  }
  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return stiffness(slot) * *at * *step;
  }
  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = stiffness(slot) * *x;
    *out.hessian = stiffness(slot);
  }
};

class HardeningObstacle final : public FunctionalObstacle<1, Hardening>, public Renewal<1> {
 public:
  explicit HardeningObstacle(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 2}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      unbounded(constraints[k], 1);
      constraints[k].direction[0][0] = 1;
      constraints[k].data[1] = 50 * vertices[k].measure;
    }
  }
  const Renewal<1>* renewal() const noexcept override { return this; }
  void renew(const LevelView<1>& level, Index first, Index last, const double*, double* data) const noexcept override {
    for (Index slot = 0; slot < level.slots; ++slot) {
      if (level.constrained[slot] < first || level.constrained[slot] >= last) continue;
      const double before = level.before[Offset{slot} * level.width];
      data[Offset{slot} * level.width] = std::fmax(before, std::fabs(level.x[level.constrained[slot]]));
    }
  }
};

/// A one-sided spring under the body, k (c - v_y)+^2 / 2. Data: k. The surface may be moved along it.
struct Spring {
  static constexpr double c = -0.01;
  static double gap(const double* v) { return v[0] < c ? c - v[0] : 0; }
  static void minimise(const Slot<2>& slot, const double* M, const double* r, const double* x, double* y) {
    const double k = slot.data[0];
    for (const bool pressed : {false, true}) {
      double K[4] = {M[0] + (pressed ? k : 0), M[1], M[2], M[3]};
      const double f[2] = {r[0] + (pressed ? k * (c - x[0]) : 0), r[1]};
      const double det = K[0] * K[3] - K[1] * K[2];
      y[0] = x[0] + (K[3] * f[0] - K[1] * f[1]) / det;
      y[1] = x[1] + (K[0] * f[1] - K[2] * f[0]) / det;
      if (pressed == (y[0] < c)) return;
    }
  }
  static double change(const Slot<2>& slot, const double* from, const double* to) {
    return 0.5 * slot.data[0] * (gap(to) - gap(from)) * (gap(to) + gap(from));
  }
  static double slope(const Slot<2>& slot, const double* at, const double* step) {
    return -slot.data[0] * gap(at) * step[0];
  }
  static void linearise(const Slot<2>& slot, const double* x, const QuadraticModel<2>& out) {
    if (!(x[0] < c)) return;
    out.gradient[0] = -slot.data[0] * gap(x);
    out.hessian[0] = slot.data[0];
  }
};

class SpringObstacle final : public FunctionalObstacle<2, Spring> {
 public:
  explicit SpringObstacle(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", 1, 1}}, 1}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<2>* constraints,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      unbounded(constraints[k], 1);
      constraints[k].direction[0][1] = 1;
      constraints[k].data[0] = 20 * vertices[k].measure;
    }
  }
};

/// g |a . v| for one direction a along the surface, its second one: what is on rails does not leave them. Data: g.
struct Rail {
  static double size(const double* v) { return std::fabs(v[1]); }
  static void minimise(const Slot<3>& slot, const double* M, const double* r, const double* x, double* y) {
    for (const int sign : {0, 1, -1}) {  // on the rail, or off to either side
      double left[3] = {r[0], r[1] - sign * slot.data[0], r[2]}, d[3] = {}, z[3];
      if (sign == 0) d[1] = -x[1];
      block::subtract_product<3>(M, d, left);
      block::solve<3>(M, left, sign == 0 ? 5u : 7u, z);
      for (int i = 0; i < 3; ++i) y[i] = x[i] + d[i] + z[i];
      if (sign == 0) y[1] = 0;
      if (sign * y[1] > 0) return;
      if (sign != 0) continue;
      double force[3] = {r[0], r[1], r[2]}, step[3];
      for (int i = 0; i < 3; ++i) step[i] = y[i] - x[i];
      block::subtract_product<3>(M, step, force);
      if (std::fabs(force[1]) <= slot.data[0]) return;
    }
  }
  static double change(const Slot<3>& slot, const double* from, const double* to) {
    return slot.data[0] * (size(to) - size(from));
  }
  static double slope(const Slot<3>& slot, const double* at, const double* step) {
    return slot.data[0] * (at[1] == 0 ? size(step) : at[1] > 0 ? step[1] : -step[1]);
  }
  static void linearise(const Slot<3>& slot, const double* x, const QuadraticModel<3>& out) {
    if (x[1] == 0) {
      *out.critical |= 2;
      out.lower[1] = out.upper[1] = 0;
    } else {
      out.gradient[1] = x[1] > 0 ? slot.data[0] : -slot.data[0];
    }
  }
};

class RailObstacle final : public FunctionalObstacle<3, Rail> {
 public:
  explicit RailObstacle(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {2, {{"normal", 1, 1}, {"rail", 1, 1}}, 1}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<3>* constraints,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      unbounded(constraints[k], 2);
      constraints[k].direction[0][2] = 1;
      constraints[k].direction[1][0] = std::cos(0.5);
      constraints[k].direction[1][1] = std::sin(0.5);
      constraints[k].data[0] = 1000 * vertices[k].measure;
    }
  }
};

/// Says that it has more numbers than a slot can hold.
class Greedy final : public FunctionalObstacle<1, Cost> {
 public:
  explicit Greedy(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, most_data + 1}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<1>*, Status&) const noexcept override {}
};

/// Adds to the energy, and does not say how it looks near an iterate.
class Vague final : public BoxObstacle<1>, public Functional<1> {
 public:
  explicit Vague(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 0}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<1>*, Status&) const noexcept override {}
  const Functional<1>* functional() const noexcept override { return this; }
  double change(const LevelView<1>&, Index, Index, const double*, const double*) const noexcept override { return 0; }
  double slope(const LevelView<1>&, Index, Index, const double*, const double*) const noexcept override { return 0; }
};

/// An obstacle that says one thing of itself wrongly.
class Misdescribed : public CostObstacle {
 public:
  Misdescribed(const Settings& settings, const ObstacleDescriptor& descriptor)
      : CostObstacle(settings), descriptor_(descriptor) {}
  ObstacleDescriptor descriptor() const noexcept override { return descriptor_; }

 private:
  ObstacleDescriptor descriptor_;
};

struct Wide final : Misdescribed {
  explicit Wide(const Settings& settings) : Misdescribed(settings, {1, {{"value", 3, 1}}, 0}) {}
};
struct Nameless final : Misdescribed {
  explicit Nameless(const Settings& settings) : Misdescribed(settings, {1, {{nullptr, 1, 1}}, 0}) {}
};
struct Silent final : Misdescribed {
  explicit Silent(const Settings& settings) : Misdescribed(settings, {0, {}, 0}) {}
};

/// Gives more numbers than it tells of.
struct Talkative final : Misdescribed {
  explicit Talkative(const Settings& settings) : Misdescribed(settings, {1, {{"value", 1, 1}}, 1}) {}
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    CostObstacle::assemble(vertices, count, constraints, status);
    for (std::size_t k = 0; k < count; ++k) constraints[k].data[1] = 1;
  }
};

/// A local solver without an answer.
struct Lost : Cost {
  static void minimise(const Slot<1>&, const double*, const double*, const double*, double* y) { *y = std::nan(""); }
};
class LostObstacle final : public FunctionalObstacle<1, Lost> {
 public:
  explicit LostObstacle(const Settings& settings) : cost_(settings) {}
  ObstacleDescriptor descriptor() const noexcept override { return cost_.descriptor(); }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    cost_.assemble(vertices, count, constraints, status);
  }

 private:
  CostObstacle cost_;
};

/// A local solver that calls everything a solution.
struct Idle : Cost {
  static void minimise(const Slot<1>&, const double*, const double*, const double* x, double* y) { *y = *x; }
};
/// Changes by twice what its slope says.
struct Contrary : Cost {
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    return 2 * Cost::change(slot, from, to);
  }
};
template <class Phi>
class Faulty final : public FunctionalObstacle<1, Phi> {
 public:
  explicit Faulty(const Settings& settings) : cost_(settings) {}
  ObstacleDescriptor descriptor() const noexcept override { return cost_.descriptor(); }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    cost_.assemble(vertices, count, constraints, status);
  }

 private:
  CostObstacle cost_;
};

/// Gives something else than it may.
template <int Fault>
class Misleading final : public CostObstacle {
 public:
  using CostObstacle::CostObstacle;
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    CostObstacle::assemble(vertices, count, constraints, status);
    if (Fault == 0) status.fail(0, "it cannot");
    if (Fault == 1) constraints[0].direction[0][0] = 2;
    if (Fault == 2) constraints[0].upper[0] = std::nan("");
    if (Fault == 3) constraints[0].direction[0][0] = std::nan("");
  }
};

/// c (v - l)^2 / (2 dt), l being v at the end of the last load step: c dv/dt against the motion. Data: c / dt.
struct Drag {
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    *y = (*r + *M * *x + slot.data[0] * *slot.last) / (*M + slot.data[0]);
  }
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    return 0.5 * slot.data[0] * (*to - *from) * ((*to - *slot.last) + (*from - *slot.last));
  }
  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return slot.data[0] * (*at - *slot.last) * *step;
  }
  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = slot.data[0] * (*x - *slot.last);
    *out.hessian = slot.data[0];
  }
};

/// A body in something viscous. Of steps longer than `longest` it makes a problem without solution: c doubles and
/// halves with every renewal.
class DragObstacle : public FunctionalObstacle<1, Drag>, public Renewal<1>, public Stepping {
 public:
  static constexpr double c = 4;
  explicit DragObstacle(const Settings& settings) : longest_(settings.number("longest")) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 1}; }
  void begin(const LoadStep& step, Status& status) noexcept override {
    length_ = step.to - step.from;
    if (!(length_ > 0) || step.number < 1) status.fail(static_cast<int>(Exit::plugin), "this is no step");
  }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      unbounded(constraints[k], 1);
      constraints[k].direction[0][0] = 1;
      constraints[k].data[0] = c / length_ * vertices[k].measure;
    }
  }
  const Renewal<1>* renewal() const noexcept override { return this; }
  void renew(const LevelView<1>& level, Index first, Index last, const double*, double* data) const noexcept override {
    if (length_ <= longest_) return;
    for (Index slot = 0; slot < level.slots; ++slot)
      if (level.constrained[slot] >= first && level.constrained[slot] < last) {
        const Offset at = Offset{slot} * level.width;
        data[at] = std::fabs(level.x[level.constrained[slot]] - level.last[slot]) > 0.02 ? 3 * level.data[at]
                                                                                         : level.data[at] / 3;
      }
  }

 private:
  double length_ = 0, longest_;
};
class StubbornDrag final : public DragObstacle {
 public:
  using DragObstacle::DragObstacle;
  bool may_be_cut() const noexcept override { return false; }
};
constexpr OptionSpec longest[] = {{"longest", OptionType::number, "1e9", "(0, inf)", "step that has a solution"}};

/// k ((n . [v])^2 + (t . [v])^2) / 2 between bodies, however far apart. Data: k.
struct Cushion {
  static void minimise(const Slot<2>& slot, const double* M, const double* r, const double* x, double* y) {
    const double k = slot.data[0], K[4] = {M[0] + k, M[1], M[2], M[3] + k}, f[2] = {r[0] - k * x[0], r[1] - k * x[1]};
    const double det = K[0] * K[3] - K[1] * K[2];
    y[0] = x[0] + (K[3] * f[0] - K[1] * f[1]) / det;
    y[1] = x[1] + (K[0] * f[1] - K[2] * f[0]) / det;
  }
  static double change(const Slot<2>& slot, const double* from, const double* to) {
    double sum = 0;
    for (int i = 0; i < 2; ++i) sum += (to[i] - from[i]) * (to[i] + from[i]);
    return 0.5 * slot.data[0] * sum;
  }
  static double slope(const Slot<2>& slot, const double* at, const double* step) {
    return slot.data[0] * (at[0] * step[0] + at[1] * step[1]);
  }
  static void linearise(const Slot<2>& slot, const double* x, const QuadraticModel<2>& out) {
    for (int i = 0; i < 2; ++i) {
      out.gradient[i] = slot.data[0] * x[i];
      out.hessian[3 * i] = slot.data[0];
    }
  }
};

class CushionObstacle final : public FunctionalObstacle<2, Cushion> {
 public:
  static constexpr double k = 0.25;
  explicit CushionObstacle(const Settings&) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", 2, 1}}, 1}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<2>* constraints,
                Status&) const noexcept override {
    for (std::size_t n = 0; n < count; ++n) {
      unbounded(constraints[n], 1);
      std::copy_n(vertices[n].away, 2, constraints[n].direction[0]);
      constraints[n].data[0] = k * vertices[n].measure;
    }
  }
};

void register_all(Registrar& registrar, Status& status) {
  const auto add = [&](const char* id, Obstacle<1>* (*one)(const Settings&, Status&) noexcept,
                       Obstacle<2>* (*two)(const Settings&, Status&) noexcept,
                       Obstacle<3>* (*three)(const Settings&, Status&) noexcept) {
    registrar.obstacle({id, "for a test", nullptr, 0, false, one, two, three}, status);
  };
  add("cost", sdk::create<CostObstacle, 1>, nullptr, nullptr);
  add("hardening", sdk::create<HardeningObstacle, 1>, nullptr, nullptr);
  add("greedy", sdk::create<Greedy, 1>, nullptr, nullptr);
  add("vague", sdk::create<Vague, 1>, nullptr, nullptr);
  add("wide", sdk::create<Wide, 1>, nullptr, nullptr);
  add("nameless", sdk::create<Nameless, 1>, nullptr, nullptr);
  add("silent", sdk::create<Silent, 1>, nullptr, nullptr);
  add("talkative", sdk::create<Talkative, 1>, nullptr, nullptr);
  add("lost", sdk::create<LostObstacle, 1>, nullptr, nullptr);
  add("idle", sdk::create<Faulty<Idle>, 1>, nullptr, nullptr);
  add("contrary", sdk::create<Faulty<Contrary>, 1>, nullptr, nullptr);
  add("shrug", sdk::create<Misleading<0>, 1>, nullptr, nullptr);
  add("long_direction", sdk::create<Misleading<1>, 1>, nullptr, nullptr);
  add("no_bound", sdk::create<Misleading<2>, 1>, nullptr, nullptr);
  add("no_direction", sdk::create<Misleading<3>, 1>, nullptr, nullptr);
  registrar.obstacle({"drag", "for a test", longest, 1, false, sdk::create<DragObstacle, 1>, nullptr, nullptr}, status);
  registrar.obstacle({"stubborn_drag", "for a test", longest, 1, false, sdk::create<StubbornDrag, 1>, nullptr, nullptr},
                     status);
  registrar.obstacle(
      {"cushion", "for a test", nullptr, 0, false, nullptr, sdk::create<CushionObstacle, 2>, nullptr, true}, status);
  add("spring", nullptr, sdk::create<SpringObstacle, 2>, nullptr);
  add("rail", nullptr, nullptr, sdk::create<RailObstacle, 3>);
}

}  // namespace
}  // namespace signorini::test

SIGNORINI_PLUGIN("functionals", "0.1.0", "functionals of the tests", signorini::test::register_all);
