#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/mesh/curve.hpp"

namespace signorini {

/// Planes that fixes make planes of symmetry: flat faces of the boundary whose nodes move along the plane and not
/// across it, with all bodies on one side and no other face there. What the bodies do is what they and their images
/// beyond the plane would.
/// @param at nodes, ascending, beside which planes are looked for
/// @return normals outwards, of length 1; none for scalar bodies
template <int D, int B>
std::vector<Flat<D>> walls(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Index>& at);

/// Largest extent of a mesh along an axis.
template <int D>
double extent(const Mesh<D>& mesh);

/// Up to rounding of the extent of what it is part of.
template <int D>
bool lies_on(const Flat<D>& plane, const Point<D>& x, double extent);

template <int D>
Point<D> reflected(const Flat<D>& plane, Point<D> x);

}  // namespace signorini
