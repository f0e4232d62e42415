#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// The point of the curve nearest to `p`; `p` itself where all are equally near (the centre, the axis).
template <int D>
Point<D> project(const Curve<D>& curve, const Point<D>& p);

/// A vertex that a refinement puts at the middle of a straight edge, and where it belongs.
template <int D>
struct Move {
  Index vertex;
  Point<D> target;
};

/// Moves vertices of a valid mesh to their targets. Where that would take more than nine tenths of an element's volume
/// the move is halved, and in the end left undone: all elements stay positively oriented.
template <int D>
void move_vertices(Mesh<D>& mesh, const std::vector<Move<D>>& moves);

}  // namespace signorini
