#pragma once
#include <utility>
#include <vector>

#include "core/solver/components.hpp"

namespace signorini {

/// Projected block Gauss-Seidel, first over the vectors that an obstacle can reach and their neighbours, then over the
/// others: the interior follows a surface whose phases are up to date. The same as ascending order where an obstacle
/// reaches every vector.
template <int B>
class SurfaceFirst final : public Smoother<B> {
 public:
  std::unique_ptr<LevelSmoother<B>> on(const Level<B>& level) const override;
};

/// Runs first <= p < last of vectors, ascending.
using Runs = std::vector<std::pair<Index, Index>>;

/// The vectors with a slot and their neighbours, and all others.
template <int B>
std::pair<Runs, Runs> surface_and_interior(const Level<B>& level);

}  // namespace signorini
