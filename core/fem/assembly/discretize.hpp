#pragma once
#include "core/constraints/localise.hpp"
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/conditions/prescribed_rows.hpp"

namespace signorini {

/// A model on a mesh, ready to be solved, and what is needed to interpret its solution.
template <int B>
struct Discretization : LocalisedProblem<B> {
  std::vector<FixedDirections<B>> fixes;         ///< by ascending node
  std::shared_ptr<const PairedBodies<B>> pairs;  ///< where bodies may touch each other; null: none
  PrescribedRows<B> prescribed;                  ///< one for each of `fixes`
  std::vector<double> load;                      ///< of all loads, in global coordinates; B per node
  std::vector<std::array<double, B>> applied;    ///< per load of the model: its total
};

/// Finite elements for a model, of the order that the nodes have. Vectors are numbered as the nodes.
/// - Dirichlet conditions: see collect_fixes(); obstacles: see BoundCombiner.
/// - Frames, bounds and segments: see localise().
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
