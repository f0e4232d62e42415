/// Contact with a rigid obstacle and friction by Coulomb's law.
#include "obstacles/coulomb/coulomb_friction.hpp"

#include <iterator>

#include "core/sdk/plugin.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini {
namespace {

template <int B>
class Coulomb final : public FunctionalObstacle<B, CoulombFriction<B>> {
 public:
  explicit Coulomb(const Settings& settings) : settings_(settings), contact_(settings, "coulomb") {
    if (!settings.has("friction")) throw Error(Exit::input, "a coulomb obstacle needs 'friction'");
  }

  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{"normal", B, 1}, {"tangential", B - 1, 1}}, CoulombFriction<B>::data};
  }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      contact_.assemble(v, constraints[k], status);
      if (!(v.measure > 0)) continue;  // asked for the distance alone
      const double friction = status.ok() ? settings_.value("friction", 0, v.position, v.normal, status) : 0;
      if (status.ok() && !(friction >= 0)) RigidContact<B>::fail(v, "'friction' is negative", status);
      constraints[k].data[1] = friction;
    }
  }

  bool follows_solution() const noexcept override { return true; }

  void renew(const LevelView<B>& level, Index first, Index last, const double* r,
             double* data) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    for (Index slot = from; slot < to; ++slot) {
      const Index p = level.constrained[slot];
      const Offset at = Offset{p} * B;
      const Slot<B> s = this->slot_of(level, slot);
      double* own = data + Offset{slot} * level.width;
      own[0] = CoulombFriction<B>::bound(s, level.value + level.row[p] * B * B, r + at, level.x + at);
      own[1] = s.data[1];
    }
  }

  bool scale(double ratio, double* data) const noexcept override {
    data[0] *= ratio;
    return true;
  }

  bool friction(const double* data, FrictionLaw& law) const noexcept override {
    law = {data[1], 0};
    return true;
  }

 private:
  const Settings& settings_;
  RigidContact<B> contact_;
};

/// Without friction it is contact and nothing else.
template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  double friction = 0;
  if (settings.constant("friction", friction) && friction == 0)
    return sdk::guarded(status, [&]() -> Obstacle<B>* { return new FrictionlessContact<B>(settings, "coulomb"); });
  return sdk::create<Coulomb<B>, B>(settings, status);
}

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    {"friction", OptionType::field, "", "[0, inf)", "coefficient of friction"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"coulomb", "contact with a rigid obstacle and friction by Coulomb's law", options,
                      std::size(options), true, nullptr, create<2>, create<3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("coulomb", "1.0.0", "contact with a rigid obstacle and friction by Coulomb's law",
                 signorini::register_all);
