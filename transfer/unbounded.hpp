#pragma once
#include "transfer/block_transfer.hpp"

namespace signorini {

/// No bounds on coarse corrections: for methods that project the correction and search along it (truncated nonsmooth
/// Newton multigrid, Graeser and Kornhuber 2009).
template <int B>
class Unbounded final : public BlockTransfer<B> {
 public:
  void restrict_bounds(const Level<B>&, LevelSystem<B>& coarse) const override { coarse.constraints.clear_bounds(); }
};

}  // namespace signorini
