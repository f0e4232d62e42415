#pragma once

namespace signorini {

/// Friction at a slot: its tangential force is at most bound + coefficient * (the force that presses).
struct FrictionLaw {
  double coefficient, bound;
};

/// Of a functional that is friction on the tangential components: its law, for methods with a formulation of their own
/// and for results.
class Friction {
 public:
  virtual ~Friction();

  /// @param data of one slot
  virtual FrictionLaw law(const double* data) const noexcept = 0;
};

}  // namespace signorini
