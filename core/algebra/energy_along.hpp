#pragma once
#include <algorithm>
#include <cmath>
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

/// Of d'Ad, relative to d'Dd.
inline constexpr double rounding_of_energy = 1e-12;

/// Error(Exit::input) where the energy along a direction is negative by more than rounding: the matrix is indefinite.
/// @param row of the direction's largest entry, for the message
void refuse_if_negative(const EnergyAlong& energy, Offset row);

/// The same for a direction.
/// @param d B per vector
template <int B>
void refuse_if_negative_along(const BlockMatrix<B>& A, const std::vector<double>& d) {
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  refuse_if_negative(energy_along(A, d), std::max_element(d.begin(), d.end(), larger) - d.begin());
}

}  // namespace signorini
