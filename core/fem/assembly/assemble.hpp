#pragma once
#include <array>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {

/// Stiffness matrix, without any boundary condition: B = 1 diffusion, B = D elasticity. Symmetric to the last bit; time
/// and memory are linear in the mesh. Coefficients that are expressions are taken at the centroids; for quadratic
/// elements by a rule of degree 5.
/// Errors (Exit::input): a coefficient out of range, an element without positive measure.
/// @param jumps of elastic bodies: there is memory for the couplings that transform() adds
template <int D, int B>
BlockMatrix<B> stiffness(const Nodes<D>& nodes, const Model<B>& model, const Jumps<B>* jumps = nullptr);

/// Load vector, B per node: body forces or sources by a rule exact for linear fields, tractions or fluxes by one
/// exact for quartic fields; for quadratic elements both by one exact for cubic fields. An Error(Exit::input) names the
/// origin of a selection without faces. Thermal strains add the stress that holds them back times the strains of basis
/// functions, by the rule of the stiffness. Loads with Load::where_open count as zero.
/// @param totals where there are any, becomes the integral of each load
template <int D, int B>
std::vector<double> load_vector(const Nodes<D>& nodes, const Model<B>& model,
                                std::vector<std::array<double, B>>* totals = nullptr);

}  // namespace signorini
