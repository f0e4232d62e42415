#pragma once
#include <array>

#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Unit tangents to a unit normal: D = 2: the normal turned by +90 degrees; D = 3: first the projection of the
/// coordinate axis that is farthest from the normal, then the cross product of both.
std::array<Point<2>, 1> tangents(const Point<2>& normal);
std::array<Point<3>, 2> tangents(const Point<3>& normal);

/// The directions of the components of a condition at x, orthonormal: coordinate axes; the outer normal and tangents();
/// or away from the axis, around it (counterclockwise as seen from where it points to, in 2D from +z), and along it.
/// On the axis itself the first two are any that are orthogonal to it: see is_on_axis().
/// @param normal where the frame is Frame::normal
template <int D, int B>
std::array<std::array<double, B>, B> directions(const LocalFrame<B>& frame, const Point<D>& x, const Point<D>& normal);

/// Whether a cylindrical frame has no direction away from its axis at x.
template <int D, int B>
bool is_on_axis(const LocalFrame<B>& frame, const Point<D>& x);

}  // namespace signorini
