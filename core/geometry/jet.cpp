#include "core/geometry/jet.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

std::array<Point<2>, 1> axes_across(const Point<2>& up) { return {Point<2>{-up[1], up[0]}}; }

std::array<Point<3>, 2> axes_across(const Point<3>& up) {
  const auto k =
      static_cast<std::size_t>(std::ranges::min_element(up, {}, [](double x) { return std::abs(x); }) - up.begin());
  Point<3> first{};
  first[k] = 1;
  for (int i = 0; i < 3; ++i) first[i] -= up[k] * up[i];
  const double size = length<3>(first);
  for (double& x : first) x /= size;
  return {first, cross(up, first)};
}

}  // namespace

template <int D>
std::optional<Point<D>> jet_normal(std::span<const Point<D>> points, const Point<D>& up, int degree, double digits) {
  const auto axes = axes_across(up);
  const int terms = D == 2 ? degree : (degree + 1) * (degree + 2) / 2 - 1;
  double size = 0;
  for (const Point<D>& p : points) size = std::max(size, length<D>(p));
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd a(rows, terms);
  Eigen::VectorXd b(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Point<D>& p = points[static_cast<std::size_t>(r)];
    const double weight = size / length<D>(p), x = dot(p, axes[0]) / size, y = D == 3 ? dot(p, axes[D - 2]) / size : 0;
    std::array<std::array<double, 2>, highest_jet<2> + 1> power{{{weight, 1}}};
    for (int k = 1; k <= degree; ++k) power[k] = {power[k - 1][0] * x, power[k - 1][1] * y};
    int column = 0;
    for (int total = 1; total <= degree; ++total)
      for (int k = 0; k <= (D == 2 ? 0 : total); ++k) a(r, column++) = power[total - k][0] * power[k][1];
    b(r) = weight * dot(p, up) / size;
  }
  constexpr double told = 10;  // times the digits, and of double precision
  const double threshold = told * std::max(digits / size, std::numeric_limits<double>::epsilon());
  const auto [slope, rank, range] = least_squares(a, b, threshold);
  if (rank < terms) return {};
  Point<D> n = up;
  for (int k = 0; k < D - 1; ++k)
    for (int i = 0; i < D; ++i) n[i] -= slope(k) * axes[k][i];
  const double l = length<D>(n);
  for (double& x : n) x /= l;
  return n;
}

std::optional<Point<2>> end_tangent(const std::vector<Point<2>>& points, std::size_t at) {
  std::vector<double> place, curvature;  // of the circles, along the curve from the point
  double along = at == 0 ? 0 : -length<2>(difference<2>(points[1], points[0]));
  for (std::size_t i = 1; i + 1 < points.size() && place.size() < 2; ++i) {
    const Point<2> a = difference<2>(points[i], points[i - 1]), b = difference<2>(points[i + 1], points[i]),
                   c = difference<2>(points[i + 1], points[i - 1]);
    const double la = length<2>(a), lb = length<2>(b);
    along += la;
    place.push_back(along + (lb - la) / 3);
    curvature.push_back(2 * (a[0] * b[1] - a[1] * b[0]) / (la * lb * length<2>(c)));
  }
  const Point<2> chord = difference<2>(points[at + 1], points[at]);
  const double h = length<2>(chord);
  double there = curvature[0];
  if (place.size() == 2) there += (h / 3 - place[0]) / (place[1] - place[0]) * (curvature[1] - curvature[0]);
  const double s = h / 2 * there;
  if (!(std::abs(s) < 0.5)) return {};
  const double c = std::sqrt(1 - s * s);
  return Point<2>{(c * chord[0] + s * chord[1]) / h, (c * chord[1] - s * chord[0]) / h};
}

template std::optional<Point<2>> jet_normal<2>(std::span<const Point<2>>, const Point<2>&, int, double);
template std::optional<Point<3>> jet_normal<3>(std::span<const Point<3>>, const Point<3>&, int, double);

}  // namespace signorini::geometry
