#pragma once
#include "core/fem/elements/element.hpp"

namespace signorini {

/// Gradient of B components: row i holds the derivatives of component i.
template <int D, int B>
using Gradient = std::array<Point<D>, B>;

/// Gradient of a finite element function u, B per node, on an element with these nodes where its basis functions have
/// these gradients.
template <int D, int B, std::size_t N>
inline Gradient<D, B> gradient(const std::array<Point<D>, N>& basis_gradients, const std::array<Index, N>& nodes,
                               const std::vector<double>& u) {
  Gradient<D, B> g{};
  for (std::size_t a = 0; a < N; ++a)
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < D; ++j) g[i][j] += u[Offset{nodes[a]} * B + i] * basis_gradients[a][j];
  return g;
}

}  // namespace signorini
