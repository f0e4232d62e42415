#pragma once
#include <vector>

#include "core/fem/elements/element.hpp"
#include "core/fem/model/material.hpp"

namespace signorini {

/// A pressure on a segment, linear from one place to another one of it, and none elsewhere.
struct PressureOnPart {
  double from, to;  ///< in units of the segment, from < to
  double first, last;
};

/// The energy norm of a stress in a triangle, without divergence, whose traction on one side is d times what a pressure
/// has beside its linear part, and zero on the others: on the triangles with the ends of parts and the vertex opposite,
/// forces and moments are handed on from one to the next.
/// @param corner the side's ends, then the vertex opposite
/// @param parts of the pressure, which do not overlap
/// @param linear values of the linear part at the ends: with the same force and moment
double norm_of_uneven(const std::array<Point<2>, 3>& corner, const Material<2>& material, const Point<2>& d,
                      std::vector<PressureOnPart> parts, const std::array<double, 2>& linear);

}  // namespace signorini
