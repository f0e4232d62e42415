#include "core/mesh/cubic_patch.hpp"

#include <algorithm>

#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

double power(double x, int n) {
  double out = 1;
  for (; n > 0; --n) out *= x;
  return out;
}

constexpr double factorial[] = {1, 1, 2, 6};

template <int D>
void add(Point<D>& sum, double factor, const Point<D>& p) {
  for (int i = 0; i < D; ++i) sum[i] += factor * p[i];
}

/// Of x^n, k times.
double derivative(double x, int n, int k) {
  double factor = 1;
  for (int i = 0; i < k; ++i) factor *= n - i;
  return n < k ? 0 : factor * power(x, n - k);
}

/// The derivative of a Bernstein polynomial as often by each coordinate as `orders` says.
template <int D>
double bernstein(const std::array<int, D>& exponent, const std::array<double, D>& x, const std::array<int, D>& orders) {
  double out = 6;
  for (int k = 0; k < D; ++k) out *= derivative(x[k], exponent[k], orders[k]) / factorial[exponent[k]];
  return out;
}

}  // namespace

template <int D>
Point<D> CubicPatch<D>::at(const std::array<double, D>& x) const {
  constexpr auto all = exponents();
  Point<D> out{};
  for (std::size_t k = 0; k < size; ++k) add<D>(out, bernstein<D>(all[k], x, {}), control[k]);
  return out;
}

template <int D>
typename CubicPatch<D>::Derivatives CubicPatch<D>::derivatives(const std::array<double, D>& x) const {
  constexpr auto all = exponents();
  Derivatives out;
  for (std::size_t k = 0; k < size; ++k) {
    add<D>(out.value, bernstein<D>(all[k], x, {}), control[k]);
    for (int a = 0; a < D; ++a) {
      std::array<int, D> orders{};
      ++orders[a];
      add<D>(out.first[a], bernstein<D>(all[k], x, orders), control[k]);
      for (int b = 0; b < D; ++b) {
        ++orders[b];
        add<D>(out.second[a][b], bernstein<D>(all[k], x, orders), control[k]);
        --orders[b];
      }
    }
  }
  return out;
}

// By blossoms: the polar form, symmetric and linear in three points, which is the surface where they are one. Control
// points are its values at corners (Farin, Curves and Surfaces for CAGD, sections 4.4 and 17.3).
template <int D>
CubicPatch<D> CubicPatch<D>::part(const std::array<std::array<double, D>, D>& corner) const {
  constexpr auto all = exponents();
  CubicPatch out;
  for (std::size_t k = 0; k < size; ++k) {
    std::array<int, 3> points;  // corners, each as often as the exponent says
    for (int i = 0, n = 0; i < D; ++i)
      for (int times = 0; times < all[k][i]; ++times) points[n++] = i;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b)
        for (int c = 0; c < D; ++c) {
          std::array<int, D> exponent{};
          for (const int i : {a, b, c}) ++exponent[i];
          const auto at = static_cast<std::size_t>(std::ranges::find(all, exponent) - all.begin());
          add<D>(out.control[k], corner[points[0]][a] * corner[points[1]][b] * corner[points[2]][c], control[at]);
        }
  }
  return out;
}

template <int D>
CubicPatch<D> patch_with_tangents(const std::array<Point<D>, D>& corner,
                                  const std::array<std::array<Point<D>, D>, D>& tangent) {
  CubicPatch<D> out;
  std::copy(corner.begin(), corner.end(), out.control.begin());
  constexpr auto edges = simplex_edges<D - 1>();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [a, b] = edges[k];
    Point<D>&first = out.control[D + 2 * k], &second = out.control[D + 2 * k + 1];
    add<D>(first = corner[a], 1.0 / 3, tangent[a][b]);
    add<D>(second = corner[b], 1.0 / 3, tangent[b][a]);
  }
  if constexpr (D == 3) {
    Point<D>& middle = out.control[CubicPatch<D>::size - 1];
    for (int k = 0; k < D; ++k) add<D>(middle, -1.0 / 6, corner[k]);
    for (std::size_t k = 0; k < 2 * edges.size(); ++k) add<D>(middle, 1.0 / 4, out.control[D + k]);
  }
  return out;
}

template <int D>
CubicPatch<D> flat_patch(const std::array<Point<D>, D>& corner) {
  std::array<std::array<Point<D>, D>, D> tangent;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) tangent[a][b] = difference<D>(corner[b], corner[a]);
  return patch_with_tangents<D>(corner, tangent);
}

#define SIGNORINI_INSTANTIATE(D)                                                \
  template struct CubicPatch<D>;                                                \
  template CubicPatch<D> flat_patch<D>(const std::array<Point<D>, D>&);         \
  template CubicPatch<D> patch_with_tangents<D>(const std::array<Point<D>, D>&, \
                                                const std::array<std::array<Point<D>, D>, D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
