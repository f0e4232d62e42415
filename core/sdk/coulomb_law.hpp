#pragma once
#include "core/sdk/coulomb_friction.hpp"
#include "core/sdk/given_friction.hpp"

namespace signorini {

/// Friction by Coulomb's law along the one direction that an implementation bounds: what is left to it is assemble(),
/// which writes the coefficient of friction to the second number, LocalConstraint::data[1].
template <int B>
class CoulombLaw : public FunctionalObstacle<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>>,
                   public Renewal<B>,
                   public Scaling,
                   public Friction {
 public:
  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{"normal", B, 1}, {"tangential", B - 1, 1}}, CoulombFriction<B>::data};
  }

  const Renewal<B>* renewal() const noexcept override { return this; }
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

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

  const Friction* friction() const noexcept override { return this; }
  FrictionLaw law(const double* data) const noexcept override { return {data[1], 0}; }
};

}  // namespace signorini
