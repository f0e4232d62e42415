#include "core/mesh/quadrature.hpp"

#include <cmath>
#include <vector>

namespace signorini {
namespace {

// The K + 1 points with one coordinate 1 - K a and all others a.
template <int K>
void add_corners(std::vector<QuadraturePoint<K>>& rule, double a, double weight) {
  for (int corner = 0; corner <= K; ++corner) {
    QuadraturePoint<K> q{{}, weight};
    q.barycentric.fill(a);
    q.barycentric[corner] = 1 - K * a;
    rule.push_back(q);
  }
}

// The six points of a tetrahedron with two coordinates a and two 1/2 - a.
void add_edges(std::vector<QuadraturePoint<3>>& rule, double a, double weight) {
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      QuadraturePoint<3> q{{}, weight};
      q.barycentric.fill(0.5 - a);
      q.barycentric[i] = q.barycentric[j] = a;
      rule.push_back(q);
    }
}

template <int K>
std::vector<QuadraturePoint<K>> degree2() {
  std::vector<QuadraturePoint<K>> rule;
  // (1 - 1/sqrt(K + 2)) / (K + 1): Gauss points, the 3-point and the 4-point rule.
  add_corners<K>(rule, (1 - 1 / std::sqrt(K + 2.0)) / (K + 1), 1.0 / (K + 1));
  return rule;
}

template <int K>
std::vector<QuadraturePoint<K>> degree5();

template <>
std::vector<QuadraturePoint<1>> degree5<1>() {
  std::vector<QuadraturePoint<1>> rule{{{0.5, 0.5}, 4.0 / 9}};
  add_corners<1>(rule, (1 - std::sqrt(0.6)) / 2, 5.0 / 18);
  return rule;
}

template <>
std::vector<QuadraturePoint<2>> degree5<2>() {
  const double s = std::sqrt(15.0);
  std::vector<QuadraturePoint<2>> rule{{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.225}};
  add_corners<2>(rule, (6 - s) / 21, (155 - s) / 1200);
  add_corners<2>(rule, (6 + s) / 21, (155 + s) / 1200);
  return rule;
}

template <>
std::vector<QuadraturePoint<3>> degree5<3>() {
  std::vector<QuadraturePoint<3>> rule;
  add_corners<3>(rule, 0.31088591926330060980, 0.11268792571801585080);
  add_corners<3>(rule, 0.092735250310891226402, 0.073493043116361949544);
  add_edges(rule, 0.045503704125649649492, 0.042546020777081466438);
  return rule;
}

}  // namespace

template <int K>
std::span<const QuadraturePoint<K>> quadrature2() {
  static const std::vector<QuadraturePoint<K>> rule = degree2<K>();
  return rule;
}

template <int K>
std::span<const QuadraturePoint<K>> quadrature5() {
  static const std::vector<QuadraturePoint<K>> rule = degree5<K>();
  return rule;
}

template std::span<const QuadraturePoint<1>> quadrature2<1>();
template std::span<const QuadraturePoint<2>> quadrature2<2>();
template std::span<const QuadraturePoint<3>> quadrature2<3>();
template std::span<const QuadraturePoint<1>> quadrature5<1>();
template std::span<const QuadraturePoint<2>> quadrature5<2>();
template std::span<const QuadraturePoint<3>> quadrature5<3>();

}  // namespace signorini
