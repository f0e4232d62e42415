#pragma once
#include "core/algebra/sparse_rows.hpp"

/// Finite differences for -div(a grad u) on the inner nodes of a grid on the unit square or cube, zero on the boundary,
/// row by row. Harmonic means between nodes of different coefficients.
namespace signorini::bench {

/// How much a coefficient varies.
struct Coefficient {
  double jump = 1;        ///< in every second of 8 x 8 (x 8) boxes, checkerboard-like
  double anisotropy = 1;  ///< of x over the other directions
};

/// @param dimension 2 or 3
/// @param nodes inner nodes along an edge
SparseRows diffusion_matrix(int dimension, int nodes, const Coefficient& coefficient = {});

}  // namespace signorini::bench
