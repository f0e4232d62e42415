#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.hpp"

/// Symmetric bodies: the mesh is the part on one side of each plane of symmetry (Mesh::mirrors). These planes run along
/// coordinate planes, each along another one, so that the body consists of 2^k images of the mesh.
namespace signorini {

constexpr std::string_view axis_name(int axis) { return std::string_view("xyz").substr(axis, 1); }

/// "x = 0", with the letter of the axis.
std::string plane_name(const Mirror& mirror);

template <int D>
bool lies_on(const Mirror& mirror, const Point<D>& x) {
  return x[mirror.axis] == mirror.at;
}

/// Takes out of a direction at x what leads across the planes through x.
template <int D>
void keep_within(const std::vector<Mirror>& mirrors, const Point<D>& x, Point<D>& direction) {
  for (const Mirror& mirror : mirrors)
    if (lies_on<D>(mirror, x)) direction[mirror.axis] = 0;
}

template <int D>
Point<D> reflected(const Mirror& mirror, Point<D> x) {
  x[mirror.axis] = 2 * mirror.at - x[mirror.axis];
  return x;
}

/// Makes this one of the mesh's planes of symmetry. Vertices that are on it up to 1e-6 of the mesh's extent are moved
/// exactly onto it. Error(Exit::input) at `place` where the mesh lies on both sides of the plane, or has no face on it.
template <int D>
void add_mirror(Mesh<D>& mesh, const Mirror& mirror, std::string_view place);

/// Takes the faces on planes of symmetry out of the boundary: the body goes on beyond them.
template <int D>
void remove_faces_on_mirrors(Mesh<D>& mesh);

}  // namespace signorini
