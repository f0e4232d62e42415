#pragma once
#include "core/fem/conditions/bounds.hpp"

namespace signorini {

/// Bounds of values at nodes become bounds of coefficients there: at midpoints of quadratic elements, where the bounds
/// are those of the quadratic function through them, along the midpoint's direction, as far as there is one: see
/// bound_bends(). Where the value along a bound is prescribed, bound and coefficient are as far apart as bound and
/// value. Bound::gap is a coefficient already.
/// @param fixes by ascending node, in coefficients
/// @param bounds by ascending node
template <int D, int B>
void bound_coefficients(const Nodes<D>& nodes, const Model<B>& model, const std::vector<FixedDirections<B>>& fixes,
                        std::vector<Bound<B>>& bounds);

}  // namespace signorini
