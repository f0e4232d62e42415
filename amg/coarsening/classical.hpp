#pragma once
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation from a coarser level chosen by the matrix alone: strength of connection, the first pass of Ruge and
/// Stueben, where that leaves many coarse vectors a second one among them, and F-F interpolation (De Sterck et al.,
/// Numer. Linear Algebra Appl. 15, 2008) without small weights. On a uniform grid that gives the bilinear interpolation
/// from every second line. Weights are positive; those of a row sum to one, or to less where a scalar matrix says that
/// constants have energy, next to prescribed values. Coarse vectors keep the order of their twins.
/// @param off components prescribed; vectors without any other one take no part
/// @param gently split coarse vectors again only where several paths couple them: a line keeps every second one
template <int B>
Prolongation classical_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off, bool gently = false);

}  // namespace signorini
