#pragma once
#include <vector>

#include "core/algebra/products.hpp"

namespace signorini {

/// d'Ad, and d'Dd with the diagonal D of A: the scale that tells a small energy from rounding.
struct EnergyAlong {
  double of_matrix = 0, of_diagonal = 0;
};

/// @param d B per vector
template <int B>
EnergyAlong energy_along(const BlockMatrix<B>& A, const std::vector<double>& d) {
  EnergyAlong out;
  for (Index p = 0; p < A.size(); ++p) {
    double Ad[B];
    row_product(A, p, d.data(), Ad);
    for (int k = 0; k < B; ++k) {
      const double component = d[Offset{p} * B + k];
      out.of_matrix += component * Ad[k];
      out.of_diagonal += A.diagonal(p)[k * B + k] * component * component;
    }
  }
  return out;
}

}  // namespace signorini
