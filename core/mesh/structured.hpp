#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// An axiparallel rectangle, each of the cells[0] x cells[1] cells cut along its diagonal from lower left to upper
/// right. Vertices are numbered lexicographically, x fastest. Parts: left right bottom top.
/// Error(Exit::input) unless from < to and cells >= 1 in every direction and the mesh can be numbered.
Mesh<2> rectangle(Point<2> from, Point<2> to, std::array<Index, 2> cells);

/// An axiparallel box, each cell cut into the six Kuhn tetrahedra around its main diagonal. Vertices are numbered
/// lexicographically, x fastest. Parts for x-, x+, y-, y+, z-, z+: left right front back bottom top.
Mesh<3> box(Point<3> from, Point<3> to, std::array<Index, 3> cells);

}  // namespace signorini
