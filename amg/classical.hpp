#pragma once
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation from a coarser level chosen by the matrix alone: strength of connection and the first pass of Ruge and
/// Stueben (Multigrid Methods, SIAM 1987, ch. 4.6), extended interpolation (De Sterck et al., Numer. Linear Algebra
/// Appl. 15, 2008). Blocks count by their norm, so that local rotations change nothing; every row of weights sums to
/// one. Coarse vectors keep the order of their twins.
/// @param off components prescribed; vectors without any other one take no part
template <int B>
Prolongation classical_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off);

}  // namespace signorini
