#pragma once
#include <array>
#include <vector>

#include "core/constraints/bound.hpp"
#include "core/constraints/fixed_directions.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// A bound of the problem that prescribed directions have been taken out of: it is `part` times a unit vector plus what
/// is prescribed.
template <int B>
struct ReducedBound {
  Offset at;                     ///< slot * B + direction
  bool upper;                    ///< or lower
  std::array<double, B> normal;  ///< of the obstacle, turned so that it grows with the local component
  double part;
};

/// Where a face of the problem comes from. [0]: its lower bound, [1]: its upper one.
template <int B>
struct FacetSource {
  std::array<Index, 2> obstacle;                ///< number among ObstaclePlaces, -1: none
  std::array<std::array<double, B>, 2> normal;  ///< see ReducedBound
  std::array<double, 2> part;
};

/// A bound whose direction is prescribed, and touched: what acts along it, on the body, is known from the residual.
template <int B>
struct HeldBound {
  Bound<B> bound;
  std::array<double, B> along;   ///< its direction in local coordinates: the force along it is that of `prescribed`
  FrictionLaw law{};             ///< of what it holds back, if anything
  std::array<double, B> last{};  ///< where the node was after the last load step, and what the obstacle has moved since
};

/// What obstacles and prescribed directions make of a problem: prescribed components, constraints, frames and segments.
/// Its matrix and right-hand side are not there yet; and where each bound comes from.
template <int B>
struct LocalisedProblem {
  DiscreteProblem<B> problem;
  /// B per slot of problem.constraints: the number of the obstacle that the lower or upper bound comes from, -1 where
  /// there is none.
  std::vector<Index> lower_obstacle, upper_obstacle;
  std::vector<char> tied;         ///< likewise: CombinedBound::tied
  std::vector<Index> functional;  ///< per slot: the obstacle whose functional acts there, -1: none; empty without any
  std::vector<FacetSource<B>> facets;    ///< per face of problem.constraints
  std::vector<ReducedBound<B>> reduced;  ///< by ascending `at`
  std::vector<HeldBound<B>> held;        ///< by ascending vector; of scalars where they touch
};

/// Obstacles see BoundCombiner.
/// - A vector with an obstacle has a local frame: first the obstacle's directions, then free tangents, then the fixed
///   directions. A vector with fixed directions only has one unless these are coordinate axes.
/// - Each obstacle rules the segments of vectors between its own constrained ones and the next obstacle's. Vectors with
///   faces and no functional are the kernel's own, see PolyhedralBox.
/// Error(Exit::no_solution) for obstacles that contradict what is prescribed or each other along one direction;
/// Error(Exit::input) for functionals that do not know what they need there.
/// @param vectors how many there are
/// @param fixes by ascending vector
/// @param bounds by ascending vector
/// @param numbers see Bound::data
template <int B>
LocalisedProblem<B> localise(const ObstaclePlaces<B>& places, std::size_t vectors,
                             const std::vector<FixedDirections<B>>& fixes, const std::vector<Bound<B>>& bounds,
                             const std::vector<FunctionalNumbers<B>>& numbers);

}  // namespace signorini
