#pragma once
#include <limits>

#include "core/fem/assembly/discretize.hpp"

namespace signorini {

/// Of the largest force: what counts as one that presses.
inline constexpr double positive_force = 1e-8;

inline constexpr double unknown_gap = std::numeric_limits<double>::quiet_NaN();

/// Of a node of an elastic body: friction, and the other body's part in contact.
template <int B>
struct BodyContact {
  bool friction = false;               ///< what slips here is held back: a bound, or in contact a coefficient, is not 0
  bool sticks = false;                 ///< with friction: no motion along the surface
  std::array<double, B> tangential{};  ///< what the obstacle exerts along the surface, global; counted in `force`
  double dissipated = 0;               ///< work of that against the motion, not negative but for rounding
  double covered = 1;                  ///< between bodies: part of the area that the other one is in front of
  double taken = 0;            ///< likewise: over its area, that of nodes beside it that are left out, and press on it
  FrictionLaw law{};           ///< where there is friction
  double start = unknown_gap;  ///< distance along `direction` before anything moved
  /// The tangential traction at the node, exerted by the obstacle, global: see recover_traction(). Where it is not
  /// recovered, force over area.
  std::array<double, B> traction{};
};
/// A scalar has none of that, and often a bound at each of its nodes.
template <>
struct BodyContact<1> {
  static constexpr bool friction = false, sticks = false;
  static constexpr double dissipated = 0, covered = 1, taken = 0, start = unknown_gap;
  static constexpr std::array<double, 1> tangential{}, traction{};
  static constexpr FrictionLaw law{};
};

/// One bounded direction of a node after the solve.
template <int B>
struct ContactNode : BodyContact<B> {
  Index vertex;    ///< the node
  Index obstacle;  ///< number in Model::obstacles of the active bound, without contact of the nearer one
  bool contact;    ///< the unknown lies on the bound
  /// All components along the obstacle's normal are prescribed: how the force divides between the obstacle and what
  /// holds the vertex is not determined. All that presses along the normal is counted as the obstacle's, and what that
  /// makes of friction where the vertex is led along the obstacle: all of it against that motion, none without one.
  bool held;
  /// Obstacles press on the vertex along dependent directions: how the force divides among them is not determined; see
  /// split_force() for what is taken.
  bool shared;
  double gap;  ///< distance to the nearer bound, along `direction`
  /// Integral of the vertex's hat function over the faces the obstacle acts on; for a scalar obstacle without faces
  /// over the body. In elasticity only those faces count that face the obstacle: whose outer normal is within 60
  /// degrees of -direction; where there is none all do.
  /// With what is taken over of nodes that are left out.
  double area;
  double pressure;  ///< consistent nodal force over covered area, positive where the obstacle pushes
  /// Exerted by the obstacle, global coordinates; without contact what a functional of the obstacle exerts, or zero.
  std::array<double, B> force;
  std::array<double, B> direction;  ///< of what presses, and of the gap; of length 1, global
  double recovered = 0;             ///< the pressure at the node, see recover_pressure(); zero without contact

  static constexpr double least_covered = 0.5;
  /// Whether so little is covered that forces, over that, make pressures of nothing.
  bool hardly_covered() const { return this->covered < least_covered; }
  /// Whether the other body ends there.
  bool partly_covered() const { return this->covered < 0.9; }
};

/// What one obstacle does to the body.
template <int B>
struct ContactSummary {
  Index nodes = 0;  ///< in contact along one direction or several; so are the other numbers of nodes
  /// Measure of the contact, up to its edge within faces: see recover_pressure(); only forces larger than 1e-8 of the
  /// largest one count. Of a scalar obstacle without faces see coincidence_set().
  double area = 0;
  std::array<double, B> force{};  ///< total
  double max_pressure = 0;        ///< the largest ContactNode::recovered
  bool resolved = true;           ///< nodes enough for pressures, see recover_pressure()
  bool peaks_at_edge = false;     ///< see recover_pressure()
  double error = infinity;        ///< of pressures, see recover_pressure(); over the largest one
  Index undetermined_nodes = 0;   ///< of those in contact the held and the shared ones
  double undetermined_force = 0;  ///< the sum of what presses there
  Index slip_nodes = 0, stick_nodes = 0;
  bool tied = false;                         ///< a tie: its nodes count as in contact, and nothing else of them
  std::array<double, B> tangential_force{};  ///< total along the surface, counted in `force`
  double dissipated = 0;
};

template <int B>
struct ContactState {
  std::vector<ContactNode<B>> nodes;         ///< by ascending vertex
  std::vector<ContactSummary<B>> obstacles;  ///< per obstacle of the model
};

/// Contact forces r = A x - b in the bounded directions, and what follows from them. Where components of a vertex are
/// prescribed the force along the free ones tells that along the whole normal; where the normal is prescribed too, see
/// ContactNode::held.
/// @param x solution in local coordinates
template <int D, int B>
ContactState<B> contact_state(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                              const std::vector<double>& x);

}  // namespace signorini
