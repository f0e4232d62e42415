#pragma once
#include <cstddef>

#include "core/sdk/friction.hpp"
#include "core/sdk/functional.hpp"
#include "core/sdk/level_view.hpp"
#include "core/sdk/linearisation.hpp"
#include "core/sdk/renewal.hpp"
#include "core/sdk/scaling.hpp"
#include "core/sdk/settings.hpp"

namespace signorini {

/// What an abstract obstacle consists of: directions, each with its number of components and of values (Krause, 4.1).
struct ObstacleDescriptor {
  struct Direction {
    const char* name;
    int components;
    int values;
  };
  int directions = 0;
  Direction direction[4] = {};
  int data = 0;  ///< numbers of its own per slot, at most most_data: LocalConstraint::data

  /// Two obstacles are of one type exactly when directions and value counts agree.
  bool same_type(const ObstacleDescriptor& other) const {
    if (directions != other.directions) return false;
    for (int k = 0; k < directions; ++k)
      if (direction[k].components != other.direction[k].components || direction[k].values != other.direction[k].values)
        return false;
    return true;
  }
};

inline constexpr int most_data = 8;

/// A vertex, or another node, that an obstacle may reach. Unused coordinates are zero.
struct SurfaceVertex {
  double position[3];
  double normal[3];  ///< averaged outer unit normal of the body's surface; zero inside it
  /// Integral of the node's basis function over the faces that the obstacle acts on, over the body where it acts on all
  /// vertices of a scalar one. Zero where no functional asks for it.
  double measure = 0;
  long vertex = -1;  ///< its number in the mesh; -1: a node that is no vertex
  /// Of types that act between bodies, see ObstacleType::takes_body; zero for others: the mean distance of the other
  /// body near the node, and the unit normal that points from there towards this one. The unknowns are then what this
  /// body moves more than the other one.
  double gap = 0;
  double away[3] = {};
};

/// What an obstacle demands of the unknowns v at one vertex: lower[k] <= direction[k] . v <= upper[k] for
/// k < directions. Directions are unit vectors, linearly independent of each other. That is all of it: the kernel's
/// line searches and coarse corrections keep within these bounds and ask for nothing else. Several obstacles at a
/// vertex make a polyhedron of their bounds. Sets that are none, such as balls and cones, are refused
/// (core/constraints/admissible_sets.hpp): bound them from outside by planes, one obstacle for each.
template <int B>
struct LocalConstraint {
  int directions = 0;
  double direction[B][B] = {};
  double lower[B], upper[B];
  double data[most_data] = {};  ///< the obstacle's own numbers: what a functional needs at this vertex
};

/// An obstacle type: everything nonlinear about a problem, all of it local to one vector. The kernel knows no more than
/// this, and calls it once per sweep and segment, never per vector. Several threads may call it at a time, for vectors
/// that the matrix does not couple. Implementations come from plugins; they derive from BoxObstacle
/// (core/sdk/box_obstacle.hpp), or from FunctionalObstacle where they add to the energy. One that derives from this
/// interface itself has a sweep of its own, on the same sets: see LocalConstraint.
template <int B>
class Obstacle {
 public:
  virtual ~Obstacle();

  virtual ObstacleDescriptor descriptor() const noexcept = 0;

  /// AssembleObstacles (Krause, 4.1): values at `count` vertices.
  virtual void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                        Status& status) const noexcept = 0;

  /// One projected block Gauss-Seidel sweep over the vectors first <= p < last in the given order: at each vector the
  /// minimiser of the local problem (Krause, 4.3), over-relaxed by level.relaxation where that meets no bound. The
  /// energy never grows.
  virtual void sweep(const LevelView<B>& level, Index first, Index last, Order order) const noexcept = 0;

  /// LocObsUpdate: for the slots of the vectors first <= p < last the bounds of an admissible correction of the iterate
  /// (lower <= 0 <= upper, B per slot) and the critical flags: bit k is set where direction k is in contact. Both are
  /// computed from the iterate, never carried along.
  virtual void distance(const LevelView<B>& level, Index first, Index last, double* lower, double* upper,
                        Flags* critical) const noexcept = 0;

  /// max over the vectors of ||x_p - Proj_K(x_p + A_pp^-1 r_p)||, Proj_K in the scalar product of A_pp; r = b - A x.
  /// With a functional: of the distance to the local minimiser.
  virtual double natural_residual(const LevelView<B>& level, Index first, Index last,
                                  const double* r) const noexcept = 0;

  // What it adds to the energy, one subject each; owned by the obstacle.

  /// Null: bounds are all there is.
  virtual const Functional<B>* functional() const noexcept { return nullptr; }
  /// Not null with a functional.
  virtual const Linearisation<B>* linearisation() const noexcept { return nullptr; }
  /// Null: the functional does not depend on the solution.
  virtual const Renewal<B>* renewal() const noexcept { return nullptr; }
  /// Null: that is not known, and starts on coarser levels of a matrix go without the functional.
  virtual const Scaling* scaling() const noexcept { return nullptr; }
  /// Null: the functional is anything else.
  virtual const Friction* friction() const noexcept { return nullptr; }
};

}  // namespace signorini
