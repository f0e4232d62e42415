#pragma once
#include <optional>
#include <span>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// A linear function that vanishes on a curve near a point: how far the point is off it, and the unit direction in
/// which that grows.
template <int D>
struct Height {
  double distance = 0;
  Point<D> normal{};
};

/// Of a curve with a closed form; nothing where all of its points are equally near (the centre, the axis; on that of a
/// cone there is no direction), and for other curves.
template <int D>
std::optional<Height<D>> height(const Curve<D>& curve, const Point<D>& p);

/// The point of the curve nearest to `p`; `p` itself where all are equally near, and for curves without closed form.
template <int D>
Point<D> project(const Curve<D>& curve, const Point<D>& p);

/// A plane (D = 2: a line) through a point, with a unit normal.
template <int D>
struct Flat {
  Point<D> point{}, normal{};
};

/// A point near `p` on several curves and planes at once, by Newton's method with the shortest steps; `p` itself where
/// it finds none within `reach`.
template <int D>
Point<D> project(std::span<const Curve<D>* const> curves, std::span<const Flat<D>> planes, const Point<D>& p,
                 double reach);

/// The smallest radius of curvature.
template <int D>
double least_radius(const Curve<D>& curve, const Point<D>& p);

/// A vertex that a refinement puts at the middle of a straight edge, and where it belongs.
template <int D>
struct Move {
  Index vertex;
  Point<D> target;
};

/// Moves vertices of a valid mesh to their targets. Where that would take more than nine tenths of an element's volume
/// the move is halved, and in the end left undone: all elements stay positively oriented.
/// @return those that have not come to their targets
template <int D>
std::vector<Index> move_vertices(Mesh<D>& mesh, const std::vector<Move<D>>& moves);

}  // namespace signorini
