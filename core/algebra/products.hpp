#pragma once
#include "core/algebra/block_matrix.hpp"
#include "core/sdk/block.hpp"

namespace signorini {

/// r = b - A x; all B per vector.
template <int B>
void residual(const BlockMatrix<B>& A, const double* x, const double* b, double* r) {
  for (Index p = 0; p < A.size(); ++p) {
    double s[B];
    for (int k = 0; k < B; ++k) s[k] = b[Offset{p} * B + k];
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      block::subtract_product<B>(A.at(k), x + Offset{A.column[k]} * B, s);
    for (int k = 0; k < B; ++k) r[Offset{p} * B + k] = s[k];
  }
}

/// y = A x
template <int B>
void product(const BlockMatrix<B>& A, const double* x, double* y) {
  for (Index p = 0; p < A.size(); ++p) {
    double s[B] = {};
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) block::add_product<B>(A.at(k), x + Offset{A.column[k]} * B, s);
    for (int k = 0; k < B; ++k) y[Offset{p} * B + k] = s[k];
  }
}

}  // namespace signorini
