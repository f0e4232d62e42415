#pragma once
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/solver/discrete_problem.hpp"

/// Numbers so large or small that no solver can compute with them: an Error(Exit::input) names the body and a vertex.
namespace signorini {

/// Coordinates whose powers, as in areas and volumes, are not finite.
template <int D, int B>
void check_lengths(const Mesh<D>& mesh, const Model<B>& model);

/// A diagonal entry that is not stored, not finite or has no finite inverse.
template <int D, int B>
void check_stiffness(const Nodes<D>& nodes, const Model<B>& model, const BlockMatrix<B>& A);

/// A load whose square or energy (after one step of Jacobi's method) is not finite.
template <int D, int B>
void check_load(const Nodes<D>& nodes, const Model<B>& model, const DiscreteProblem<B>& problem);

}  // namespace signorini
