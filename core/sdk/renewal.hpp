#pragma once
#include "core/sdk/level_view.hpp"

namespace signorini {

/// Of a functional that depends on the solution, as the normal force in Coulomb's bound: the numbers that are frozen
/// during a cycle.
template <int B>
class Renewal {
 public:
  virtual ~Renewal();

  /// Renews them from the iterate level.x and r = b - A x, at the vectors first <= p < last of one segment.
  /// @param data written like LevelView::data, which it need not be
  virtual void renew(const LevelView<B>& level, Index first, Index last, const double* r,
                     double* data) const noexcept = 0;
};

}  // namespace signorini
