#pragma once
#include "core/sdk/level_view.hpp"

namespace signorini {

/// What an obstacle adds to the energy beside its bounds: the sum of phi_p(x_p) over its slots, each phi_p convex and
/// piecewise smooth while LevelView::data rest (Krause, 2.3; Graeser and Kornhuber 2009). Energies and line searches
/// ask for it.
/// Vectors first <= p < last are those of one segment; pointers of x, from, to... are to whole vectors, B per vector.
template <int B>
class Functional {
 public:
  virtual ~Functional();

  /// phi(to) - phi(from), computed without cancellation: it is compared with gains near rounding.
  virtual double change(const LevelView<B>& level, Index first, Index last, const double* from,
                        const double* to) const noexcept = 0;

  /// Derivative of phi at `at` along `step`, to that side.
  virtual double slope(const LevelView<B>& level, Index first, Index last, const double* at,
                       const double* step) const noexcept = 0;
};

}  // namespace signorini
