#pragma once
#include <span>
#include <vector>

#include "transfer/block_transfer.hpp"

namespace signorini {

/// A coarse component that moves a fine direction: the number of its bounds, and how far the direction goes with it.
struct Term {
  Offset at;
  double weight;  ///< not zero
};

/// How monotone restrictions share a remaining distance.
enum class Share {
  equal,     ///< N terms of weights M_j: |M_j c_j| <= distance / N (Krause, figure 4.7)
  common,    ///< |c_j| <= distance / (M_1 + ... + M_N), for nonnegative scalar weights; others in equal shares (Mandel)
  sharpest,  ///< where the bounds found so far leave too much, no |M_j c_j| may be larger than what then just fits
};

/// Monotone restrictions of bounds, row by row of the interpolation (RestrictObstaclesByMatrix and merge, Krause 4.4).
/// A fine direction goes sum M_j c_j with the coarse components c_j; every row shares its remaining distance among
/// them, so that each choice of coarse corrections within their bounds is admissible on the fine level.
///
/// `sharpest` starts from the rows of a single weight and goes on from row to row. For linear elements on uniformly
/// refined meshes it is the restriction of Kornhuber (Numer. Math. 69, 1994): with bounds a <= b at the ends of an edge
/// and m in the middle, (a + b) / 2 > m, it takes (m, m) if m < a, else (a, 2m - a). It is valid for any weights and
/// frames, and nowhere tighter than equal shares.
template <int B, Share share>
class Merge final : public BlockTransfer<B> {
 public:
  void restrict_bounds(const Level<B>& fine, LevelSystem<B>& coarse) const override;

 private:
  bool is_uncoupled(const Level<B>& fine, const LevelSystem<B>& coarse) const;
  void restrict_uncoupled(const Level<B>& fine, LevelSystem<B>& coarse) const;
  void restrict_rows(const Level<B>& fine, LevelSystem<B>& coarse, bool single, bool others) const;
  void collect(const Level<B>& fine, Index p, int direction, const LevelSystem<B>& coarse,
               std::vector<Term>& terms) const;
};

template <int B>
using MinMerge = Merge<B, Share::equal>;
template <int B>
using Mandel = Merge<B, Share::common>;
template <int B>
using Kornhuber = Merge<B, Share::sharpest>;

}  // namespace signorini
