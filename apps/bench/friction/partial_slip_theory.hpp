#pragma once
#include <vector>

namespace signorini::bench {

/// An elastic half-space and a rigid paraboloid z = r^2 / (2 radius); in 2D a cylinder, with forces per unit of length.
struct RoundContact {
  int dimension;
  double radius, young, poisson, friction;
};

/// Cattaneo's and Mindlin's theory of partial slip, for one pressing force and a tangential force that goes to and fro
/// (K. L. Johnson, Contact Mechanics, Cambridge 1985, sec. 4.2, 5.6, 7.2 and 7.4).
class PartialSlipTheory {
 public:
  /// @param normal the force that presses
  PartialSlipTheory(const RoundContact& contact, double normal);

  /// The tangential force has gone straight from where it was to this value. It is below the limit of friction, and
  /// goes to and fro between the same two values once it has turned. Error(Exit::input) where it is not below it.
  void move_to(double tangential);

  double contact_radius() const { return radius_; }
  /// Of what has stuck since the force turned last, or since it began.
  double stick_radius() const;
  /// At a distance from the middle, along the force.
  double traction(double r) const;
  double peak_pressure() const { return peak_; }
  /// The largest traction there was, when the force turned first or, before that, now.
  double peak_traction() const;
  /// What friction dissipates while the force goes from `amplitude` to its opposite and back.
  double loop(double amplitude) const;

 private:
  /// A way without a turn. From a turn on, twice the distribution for half the way is added.
  struct Way {
    double weight, from, to;
  };

  double stick_part(double force) const;
  double stick_radius(const Way& way) const;
  double displacement(double tangential) const;
  double integrated_displacement(double tangential) const;

  RoundContact contact_;
  double limit_, radius_, peak_;
  std::vector<Way> ways_;
};

}  // namespace signorini::bench
