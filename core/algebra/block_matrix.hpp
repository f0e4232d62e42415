#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Square block compressed rows with compile-time block size. In every row the diagonal block comes first, the others
/// follow by ascending column; blocks are row-major.
template <int B>
struct BlockMatrix {
  static constexpr int block = B * B;
  std::vector<Offset> row{0};  ///< size() + 1
  std::vector<Index> column;
  std::vector<double> value;  ///< block entries per column

  Index size() const { return static_cast<Index>(row.size()) - 1; }
  double* at(Offset k) { return value.data() + k * block; }
  const double* at(Offset k) const { return value.data() + k * block; }
  const double* diagonal(Index p) const { return at(row[p]); }
};

}  // namespace signorini
