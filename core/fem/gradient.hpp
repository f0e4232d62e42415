#pragma once
#include "core/fem/element.hpp"

namespace signorini {

/// Gradient of B components: row i holds the derivatives of component i.
template <int D, int B>
using Gradient = std::array<Point<D>, B>;

/// Gradient of a linear element function u, B per node, on an element with these nodes.
template <int D, int B>
inline Gradient<D, B> gradient(const LinearElement<D>& element, const Simplex<D>& nodes, const std::vector<double>& u) {
  Gradient<D, B> g{};
  for (int a = 0; a <= D; ++a)
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < D; ++j) g[i][j] += u[Offset{nodes[a]} * B + i] * element.gradient[a][j];
  return g;
}

}  // namespace signorini
