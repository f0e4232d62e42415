// What docs/plugin_energies.md shows, complete: a drag that depends on the length of a step, and Coulomb's friction.
#include <iterator>

#include <signorini/sdk/coulomb_friction.hpp>
#include <signorini/sdk/given_friction.hpp>
#include <signorini/sdk/given_friction_solver.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/rigid_contact.hpp>
#include <signorini/sdk/stepping.hpp>

using namespace signorini;

namespace {

/// c (v - last)^2 / (2 length). Data: c / length * measure.
struct DragFunctional {
  static double change(const Slot<1>& slot, const double* from, const double* to) {
    return 0.5 * slot.data[0] * (*to - *from) * ((*to - *slot.last) + (*from - *slot.last));
  }
  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    return slot.data[0] * (*at - *slot.last) * *step;
  }
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    *y = block::clamp((*r + *M * *x + slot.data[0] * *slot.last) / (*M + slot.data[0]), *slot.lower, *slot.upper);
  }
  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = slot.data[0] * (*x - *slot.last);
    *out.hessian = slot.data[0];
  }
};

class Drag final : public FunctionalObstacle<1, DragFunctional>, public Scaling, public Stepping {
 public:
  explicit Drag(const Settings& settings) : settings_(settings) {}

  void begin(const LoadStep& step, Status&) noexcept override { length_ = step.to - step.from; }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 1}}, 1}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = -infinity;
      c.upper[0] = infinity;
      c.data[0] = settings_.value("drag", 0, v.position, v.normal, status) / length_ * v.measure;
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

 private:
  const Settings& settings_;
  double length_ = 1;
};

class Coulomb final : public FunctionalObstacle<2, GivenFriction<2>, GivenFrictionSolver<2>, GivenFrictionModel<2>>,
                      public Renewal<2>,
                      public Scaling {
 public:
  explicit Coulomb(const Settings& settings) : settings_(settings), contact_(settings, "page_coulomb") {}

  const Renewal<2>* renewal() const noexcept override { return this; }
  void renew(const LevelView<2>& level, Index first, Index last, const double* r, double* data) const noexcept override;

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }  // the bound; data[1] is mu

  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{"normal", 2, 1}, {"tangential", 1, 1}}, CoulombFriction<2>::data};
  }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<2>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      contact_.assemble(v, constraints[k], status);
      if (!status.ok() || !(v.measure > 0)) continue;  // asked for the distance alone
      constraints[k].data[1] = settings_.value("friction", 0, v.position, v.normal, status);
    }
  }

 private:
  const Settings& settings_;
  RigidContact<2> contact_;
};

void Coulomb::renew(const LevelView<2>& level, Index first, Index last, const double* r, double* data) const noexcept {
  const auto [from, to] = slots_between(level, first, last);
  for (Index slot = from; slot < to; ++slot) {
    const Index p = level.constrained[slot];
    const Slot<2> s = this->slot_of(level, slot);
    double* own = data + Offset{slot} * level.width;
    own[0] = CoulombFriction<2>::bound(s, level.value + level.row[p] * 4, r + Offset{p} * 2, level.x + Offset{p} * 2);
    own[1] = s.data[1];
  }
}

constexpr OptionSpec of_drag[] = {{"drag", OptionType::field, "1", "[0, inf)", "force per area and velocity"}};
constexpr OptionSpec of_coulomb[] = {
    RigidContact<2>::normal_option,
    {"friction", OptionType::field, "0.3", "[0, inf)", "coefficient of friction"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"drag", "a force against the motion", of_drag, std::size(of_drag), false, sdk::create<Drag, 1>,
                      nullptr, nullptr},
                     status);
  registrar.obstacle({"page_coulomb", "friction that follows the pressure", of_coulomb, std::size(of_coulomb), true,
                      nullptr, sdk::create<Coulomb, 2>, nullptr},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("drag", "0.1.0", "what docs/plugin_energies.md shows", register_all);
