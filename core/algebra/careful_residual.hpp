#pragma once
#include "core/algebra/block_matrix.hpp"
#include "core/algebra/two_doubles.hpp"

namespace signorini {

/// b - (A x)_p, rounded once: for rows whose terms are larger than their sum by as much as a double has digits.
inline double careful_residual(const BlockMatrix<1>& A, Index p, const double* x, double b) {
  TwoDoubles rest(b);
  for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) rest.add_product(-*A.at(k), TwoDoubles(x[A.column[k]]));
  rest.normalise();
  return rest.high;
}

/// The same at the vectors first <= p < last, r from `first` on.
inline void careful_residual(const BlockMatrix<1>& A, const double* x, const double* b, Index first, Index last,
                             double* r) {
  for (Index p = first; p < last; ++p) r[p - first] = careful_residual(A, p, x, b[p]);
}

}  // namespace signorini
