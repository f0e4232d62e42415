#pragma once
#include "core/algebra/block_matrix.hpp"
#include "core/sdk/block.hpp"

namespace signorini {

/// y = (A x)_p
template <int B>
inline void row_product(const BlockMatrix<B>& A, Index p, const double* x, double* y) {
  const Offset k = A.row[p];
  block::row_product<B>(A.at(k), A.column.data() + k, A.row[p + 1] - k, x, y);
}

/// r = b - A x at the vectors first <= p < last; all B per vector, r from `first` on.
template <int B>
void residual(const BlockMatrix<B>& A, const double* x, const double* b, Index first, Index last, double* r) {
  for (Index p = first; p < last; ++p, r += B) {
    double Ax[B];
    row_product(A, p, x, Ax);
    for (int i = 0; i < B; ++i) r[i] = b[Offset{p} * B + i] - Ax[i];
  }
}

/// r = b - A x; all B per vector.
template <int B>
void residual(const BlockMatrix<B>& A, const double* x, const double* b, double* r) {
  residual(A, x, b, 0, A.size(), r);
}

/// y = A x
template <int B>
void product(const BlockMatrix<B>& A, const double* x, double* y) {
  for (Index p = 0; p < A.size(); ++p) row_product(A, p, x, y + Offset{p} * B);
}

}  // namespace signorini
