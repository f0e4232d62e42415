#pragma once
#include "core/fem/nodes.hpp"
#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation of linear elements from a mesh to its refinement, or to quadratic elements with their nodes there:
/// weight 1 at common vertices, 1/2 at the ends of a divided edge.
template <int D>
Prolongation prolongation(const Refinement& refinement, const Nodes<D>& coarse, const Nodes<D>& fine);
/// Between all levels of a hierarchy, coarsest first.
/// @param nodes of each of its meshes
template <int D>
std::vector<Prolongation> prolongations(const MeshHierarchy<D>& hierarchy, const std::vector<Nodes<D>>& nodes);

/// A solution of one level as a start for the next finer one, both in the local coordinates of their problems.
/// Components that are prescribed on the fine level take their prescribed values.
template <int B>
std::vector<double> interpolate(const DiscreteProblem<B>& coarse, const std::vector<double>& x,
                                const Prolongation& prolongation, const DiscreteProblem<B>& fine);

/// Whether the matrix of the coarse problem is the Galerkin product P'AP of the fine one, as for nested elements with
/// the same coefficients, in the frames that a solver gives its coarser levels: compares the energies of one random
/// vector on both levels.
template <int B>
bool is_galerkin(const DiscreteProblem<B>& coarse, const Prolongation& prolongation, const DiscreteProblem<B>& fine);

}  // namespace signorini
