#pragma once
#include "transfer/block_transfer.hpp"

namespace signorini {

/// Monotone restriction by matrix and merge (Krause, 4.4 and figure 4.7), valid for weights of any sign and for any
/// coupling of directions: with N nonzero weights M_j in the interpolation of a fine direction, each coarse component
/// may use up an N-th of the remaining distance, c_j in [lower, upper] / (N M_j) (swapped for negative M_j).
template <int B>
class MinMerge final : public BlockTransfer<B> {
 public:
  void restrict_bounds(const Level<B>& fine, Level<B>& coarse) const override;

 private:
  void merge_plain(const Level<B>& fine, Index slot, int direction, Level<B>& coarse) const;
  void merge(const Level<B>& fine, Index slot, int direction, Level<B>& coarse) const;
};

}  // namespace signorini
