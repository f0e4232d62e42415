#pragma once
#include "core/solver/components.hpp"

namespace signorini {

/// Block smoothing on patches, for matrices that point smoothers hardly damp, such as those of nearly incompressible
/// material: in every step a projected Gauss-Seidel sweep, then a multiplicative Schwarz method on the vectors that no
/// obstacle can reach. A patch is a vector with its neighbours, at most 24 vectors; the centres are chosen so that each
/// vector lies in a patch. The energy is minimised exactly on every patch in turn, ascending on the way down and
/// descending on the way up. Costs memory for a dense Cholesky factor per patch.
template <int B>
class Patch final : public Smoother<B> {
 public:
  std::unique_ptr<LevelSmoother<B>> on(const Level<B>& level) const override;
};

}  // namespace signorini
