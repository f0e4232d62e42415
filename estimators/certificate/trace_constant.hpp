#pragma once
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/gradient.hpp"
#include "core/fem/model/material.hpp"

namespace signorini {

/// The largest |w - Pi w|_F^2 / |eps(w)|_T^2 on the regular simplex T with edges of length 1: Pi the projection onto
/// linear fields on its face F. Rounded up from what polynomials w of high degree have
/// (tests/estimators/trace_constant_test.cpp).
template <int D>
inline constexpr double squared_trace_constant = D == 2 ? 1.0 : 1.6;

/// The largest |tau|^2_C^-1 / |r|^2_F of stresses tau in an element T without divergence, whose tractions are r d on a
/// face F, d a unit vector, and zero on the other ones; r is any function without linear part. By duality it is that of
/// the largest |d . w - Pi (d . w)|_F^2 / |eps(w)|_C^2. With x = F x^ from the regular simplex, tau = F tau^ F' / J^2
/// and G = F'F
///     |tau|^2 <= |G|^2 / |J|^3 |tau^|^2,   |t^|^2_F^ = J^2 |F| / |F^| |F^-1 d|^2 |r|^2_F.
/// @param face its measure
template <int D>
double trace_factor(const LinearElement<D>& element, const std::array<Point<D>, D + 1>& corner,
                    const Material<D>& material, double face, const Point<D>& d) {
  // Edges e_i of the regular simplex: e_i . e_j = (1 + [i = j]) / 2, whose inverse is 2 ([i = j] - 1 / (D + 1)).
  Gradient<D, D> edges, product;
  Point<D> sums{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      edges[i][j] = dot(difference<D>(corner[i + 1], corner[0]), difference<D>(corner[j + 1], corner[0]));
      sums[i] += edges[i][j];
    }
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) product[i][j] = 2 * (edges[i][j] - sums[i] / (D + 1));
  double G2 = 0, back = 0, sum = 0;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) G2 += product[i][j] * product[j][i];
    const double along = dot(element.gradient[i + 1], d);
    back += along * along / 2;
    sum += along;
  }
  back += sum * sum / 2;
  const double regular = std::sqrt((D + 1) / std::pow(2.0, D)), regular_face = D == 2 ? 1 : std::sqrt(3.0) / 4;
  const double J = (D == 2 ? 2 : 6) * element.measure / regular;
  const double least = std::min(2 * material.mu, 2 * material.mu + D * material.lambda);
  return squared_trace_constant<D> * G2 * back * face / (regular_face * J * least);
}

}  // namespace signorini
