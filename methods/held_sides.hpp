#pragma once
#include "core/sdk/polyhedron.hpp"

namespace signorini {

/// Sides of a vector's polyhedron that it is held on, where there are facets: numbers from 1 on, in the order of
/// Polyhedron::get(), ascending; 0 behind the last one. Their normals are independent, so that they are never more than
/// there are components.
template <int B>
struct HeldSides {
  short number[B] = {};

  bool any() const { return number[0] > 0; }
};

/// Those that x touches, and equal ones.
template <int B>
HeldSides<B> sides_at(const Polyhedron<B>& polyhedron, const double* x);

/// Those that press on the point next to `target` in the norm of the diagonal matrix d, and equal ones.
/// @param d B numbers, positive
template <int B>
HeldSides<B> sides_before(const Polyhedron<B>& polyhedron, const double* d, const double* target);

/// Those that leave no room between them and the opposite one, alone.
template <int B>
HeldSides<B> equal_sides(const Polyhedron<B>& polyhedron);

/// As many as hold the vector.
template <int B>
HeldSides<B> all_sides(const Polyhedron<B>& polyhedron);

/// Moves y onto them by a way that is orthogonal to what stays free.
template <int B>
void go_onto(const Polyhedron<B>& polyhedron, const HeldSides<B>& sides, double* y);

/// Coordinates in which the components that are `off`, and then the sides, hold the first ones.
/// @param T gets B * B numbers: orthonormal columns, the first of them along what is held
/// @return how many are held
template <int B>
int held_coordinates(const Polyhedron<B>& polyhedron, const HeldSides<B>& sides, Flags off, double* T);

}  // namespace signorini
