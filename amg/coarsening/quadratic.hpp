#pragma once
#include <optional>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation from linear to quadratic finite elements on the same mesh, found in a matrix whose unknowns are values
/// at the vertices and the midpoints of the edges: the coarse vectors are the vertices, a midpoint has half of each
/// end. Nothing where the matrix is none of those.
///
/// What tells vertices: a midpoint is coupled to the nodes of the elements around its edge, and both ends are coupled
/// to all of these and to more. What tells quadratic elements: vertices push each other the same way, where linear
/// elements on the same mesh would pull. Vectors that are neither clearly, as at corners, become coarse ones.
/// @param off components prescribed; vectors without any other one take no part
template <int B>
std::optional<Prolongation> quadratic_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off);

}  // namespace signorini
