#pragma once
#include "core/fem/conditions/bounds.hpp"

namespace signorini {

/// How the bounds of an obstacle at the midpoint m of an edge ab bend along it: b_a - 2 b_m + b_b, lower and upper.
struct BoundBend {
  double lower = 0, upper = 0;
};

/// Of quadratic functions through bounds, per bound; zero but at midpoints. A bound that jumps or has a kink within
/// the edge is no such function, and what it does there would move the midpoint's coefficient by a part of the jump. So
/// the obstacle is asked halfway between the midpoint and both ends, too, and a bend is at most twice that of either
/// half of the edge and of the part between their middles (scaled by length), zero where these bend to different sides.
/// Smooth bounds keep theirs, up to third order in the length where it changes its sign. It is zero as well where the
/// same obstacle has no bound at an end along nearly the same direction, or an infinite one. What a curved edge itself
/// is off its surface, of fourth order in its length, is no disagreement. It is zero where the
/// obstacle says nothing between the nodes.
/// @param bounds of collect_bounds()
template <int D, int B>
std::vector<BoundBend> bound_bends(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Bound<B>>& bounds);

}  // namespace signorini
