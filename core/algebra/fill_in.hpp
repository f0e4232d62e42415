#pragma once
#include <algorithm>
#include <vector>

#include "core/algebra/block_matrix.hpp"

namespace signorini {

/// Copies the blocks of a matrix to their places in one with a wider pattern.
/// @param position scratch, one per column; what it holds does not matter but for being no place of a later row
/// @param missing called with row and column of a block that has no place there
template <int B, class Missing>
void fill_in(const BlockMatrix<B>& A, BlockMatrix<B>& wider, std::vector<Offset>& position, const Missing& missing) {
  for (Index q = 0; q < A.size(); ++q) {
    for (Offset k = wider.row[q]; k < wider.row[q + 1]; ++k) position[wider.column[k]] = k;
    for (Offset k = A.row[q]; k < A.row[q + 1]; ++k) {
      const Offset to = position[A.column[k]];
      if (to >= wider.row[q] && to < wider.row[q + 1])
        std::copy_n(A.at(k), B * B, wider.at(to));
      else
        missing(q, A.column[k]);
    }
  }
}

}  // namespace signorini
