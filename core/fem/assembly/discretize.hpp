#pragma once
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/conditions/prescribed_rows.hpp"
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
  std::array<Index, 2> obstacle;                ///< number in Model::obstacles, -1: none
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

/// A model on a mesh, ready to be solved, and what is needed to interpret its solution.
template <int B>
struct Discretization {
  DiscreteProblem<B> problem;
  /// B per slot of problem.constraints: the number in Model::obstacles that the lower or upper bound comes from, -1
  /// where there is none.
  std::vector<Index> lower_obstacle, upper_obstacle;
  std::vector<char> tied;         ///< likewise: CombinedBound::tied
  std::vector<Index> functional;  ///< per slot: the obstacle whose functional acts there, -1: none; empty without any
  std::vector<FacetSource<B>> facets;            ///< per face of problem.constraints
  std::vector<ReducedBound<B>> reduced;          ///< by ascending `at`
  std::vector<HeldBound<B>> held;                ///< by ascending node; of scalars where they touch
  std::vector<FixedDirections<B>> fixes;         ///< by ascending node
  std::shared_ptr<const PairedBodies<B>> pairs;  ///< where bodies may touch each other; null: none
  PrescribedRows<B> prescribed;                  ///< one for each of `fixes`
  std::vector<double> load;                      ///< of all loads, in global coordinates; B per node
  std::vector<std::array<double, B>> applied;    ///< per load of the model: its total
};

/// Finite elements for a model, of the order that the nodes have. Vectors are numbered as the nodes.
/// - Dirichlet conditions: see collect_fixes(); obstacles: see BoundCombiner.
/// - A vector with an obstacle has a local frame: first the obstacle's directions, then free tangents, then the fixed
///   directions. A vector with fixed directions only has one unless these are coordinate axes.
/// - Each obstacle rules the segments of vectors between its own constrained ones and the next obstacle's. Vectors with
///   faces and no functional are the kernel's own, see PolyhedralBox.
/// Error(Exit::input) for selections without faces, fields that are not finite or out of range, inverted elements;
/// Error(Exit::no_solution) for obstacles that contradict the fixed boundary or each other along one direction;
/// Error(Exit::plugin) for obstacles whose sweeps admit something else than their bounds: check_admissible_sets().
/// @param pairing pair_bodies() of both, where that is known already
template <int D, int B>
Discretization<B> discretize(const Nodes<D>& nodes, const Model<B>& model,
                             std::shared_ptr<const PairedBodies<B>> pairing = nullptr);

/// What of a discretization had to be assembled.
struct Assembled {
  bool stiffness = true, load = true;
  bool turned = false;  ///< the matrix that was there has been turned to other frames

  bool same_matrix() const { return !stiffness && !turned; }
};

/// Makes `last`, the discretization of another model on the same nodes, that of `model`. Prescribed values, constraints
/// and frames are new; the stiffness matrix is assembled only where coefficients may differ, where other components are
/// prescribed, or where a frame has changed that some are prescribed in; the load vector where loads may differ (see
/// Field::same()). Errors as above; then nothing is left of `last`.
template <int D, int B>
Assembled renew(const Nodes<D>& nodes, const Model<B>& before, const Model<B>& model, Discretization<B>& last,
                std::shared_ptr<const PairedBodies<B>> pairing = nullptr);

/// Global coordinates of the displacements, or values, given by unknowns in the local ones, and back; B per vector.
template <int B>
std::vector<double> to_global(const DiscreteProblem<B>& problem, std::vector<double> x);
template <int B>
std::vector<double> to_local(const DiscreteProblem<B>& problem, std::vector<double> u);

}  // namespace signorini
