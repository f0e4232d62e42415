#pragma once
#include <functional>

#include "core/fem/elements/gradient.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

template <int D, int B>
using ExactValue = std::function<std::array<double, B>(const Point<D>&)>;
template <int D, int B>
using ExactGradient = std::function<Gradient<D, B>(const Point<D>&)>;

/// sqrt(a(u_h - u, u_h - u)) by a rule of degree 5: the error in the energy norm against a solution given by its
/// gradient. With u_h = 0 it is the energy norm of the exact solution. Not for axisymmetric models.
/// @param u in global coordinates, B per node
template <int D, int B>
double energy_error(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const ExactGradient<D, B>& exact);

/// The norm of u_h - u in L2, by the same rule.
template <int D, int B>
double l2_error(const Nodes<D>& nodes, const std::vector<double>& u, const ExactValue<D, B>& exact);

/// max over the nodes of the Euclidean norm of u_h - u.
template <int D, int B>
double max_nodal_error(const Nodes<D>& nodes, const std::vector<double>& u, const ExactValue<D, B>& exact);

}  // namespace signorini
