#pragma once
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/dense.hpp"
#include "core/mortar/couple.hpp"
#include "tests/support/random.hpp"

/// Surfaces to couple.
namespace signorini::test {

/// The dimensions that typed tests are run in: `constexpr int D = TypeParam::value`.
template <int N>
using Number = std::integral_constant<int, N>;
using Dimensions = testing::Types<Number<2>, Number<3>>;

template <int D>
struct Surface {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> faces;

  SurfaceFaces<D> side(std::string_view place = "surface") const { return {points, faces, place}; }

  /// Turns its normals round.
  void flip() {
    for (auto& face : faces) std::swap(face[0], face[1]);
  }
  Index add(const Surface& other) {
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (auto face : other.faces) {
      for (Index& v : face) v += first;
      faces.push_back(face);
    }
    return first;
  }
};

template <int K>
using Plane = std::array<double, K>;

template <int K>
struct Grid {
  Plane<K> from, to;
  std::array<int, K> cells;
  double jitter = 0;  ///< of nodes inside, as part of a cell: no more than 0.2, or cells may fold
};

template <int K>
Grid<K> grid(double from, double to, int cells, double jitter = 0) {
  Grid<K> g;
  g.from.fill(from), g.to.fill(to), g.cells.fill(cells);
  g.jitter = jitter;
  return g;
}

/// A graph over a rectangle, cells cut along either diagonal; normals point upwards.
template <int D>
Surface<D> graph(const Grid<D - 1>& g, Random& random, const std::function<double(const Plane<D - 1>&)>& height) {
  constexpr int K = D - 1;
  Surface<D> out;
  const int nx = g.cells[0], ny = K == 2 ? g.cells[K - 1] : 0;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const std::array<int, 2> at{i, j};
      Plane<K> y;
      for (int k = 0; k < K; ++k) {
        const bool inside = at[k] > 0 && at[k] < g.cells[k];
        const double shift = inside ? g.jitter * random.between(-1, 1) : 0;
        y[k] = g.from[k] + (g.to[k] - g.from[k]) * (at[k] + shift) / g.cells[k];
      }
      Point<D> x;
      std::copy(y.begin(), y.end(), x.begin());
      x[K] = height(y);
      out.points.push_back(x);
    }
  if constexpr (D == 2) {
    for (Index i = 0; i < nx; ++i) out.faces.push_back({i + 1, i});
  } else {
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        const Index a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
        const bool other = g.jitter > 0 && random.chance(0.5);
        out.faces.push_back(other ? std::array<Index, 3>{a, b, c} : std::array<Index, 3>{a, b, d});
        out.faces.push_back(other ? std::array<Index, 3>{b, d, c} : std::array<Index, 3>{a, d, c});
      }
  }
  return out;
}

/// The flat one at a height.
template <int D>
Surface<D> flat(const Grid<D - 1>& g, Random& random, double height = 0) {
  return graph<D>(g, random, [height](const Plane<D - 1>&) { return height; });
}

/// A similarity of space.
template <int D>
struct Similarity {
  Eigen::Matrix<double, D, D> rotation = Eigen::Matrix<double, D, D>::Identity();
  Point<D> shift{};
  double scale = 1;

  Point<D> turned(const Point<D>& v) const {
    const Eigen::Matrix<double, D, 1> w = rotation * Eigen::Map<const Eigen::Matrix<double, D, 1>>(v.data());
    Point<D> out;
    for (int k = 0; k < D; ++k) out[k] = w[k];
    return out;
  }
  Point<D> operator()(const Point<D>& x) const {
    Point<D> out = turned(x);
    for (int k = 0; k < D; ++k) out[k] = scale * (out[k] + shift[k]);
    return out;
  }
  void apply(Surface<D>& surface) const {
    for (auto& x : surface.points) x = (*this)(x);
  }
};

template <int D>
Similarity<D> random_similarity(Random& random, double scale = 1) {
  Similarity<D> out;
  Eigen::Matrix<double, D, D> any;
  for (int i = 0; i < D * D; ++i) any.data()[i] = random.between(-1, 1);
  out.rotation = orthonormal_columns(any);
  if (out.rotation.determinant() < 0) out.rotation.col(0) *= -1;
  for (double& s : out.shift) s = random.between(-1, 1);
  out.scale = scale;
  return out;
}

inline CoupleOptions within(double reach, Pairing pairing = Pairing::normal) {
  CoupleOptions out;
  out.reach = reach;
  out.pairing = pairing;
  return out;
}

/// The value of row `p` for a function on the master's points.
template <int D, class F>
double row_value(const MortarCoupling<D>& c, Index p, const F& f) {
  double sum = 0;
  for (Offset k = c.row[p]; k < c.row[p + 1]; ++k) sum += c.value[k] * f(c.column[k]);
  return sum;
}

template <int D>
double total_weight(const MortarCoupling<D>& c) {
  return std::accumulate(c.weight.begin(), c.weight.end(), 0.0);
}

/// ∫ φ over all faces, per point.
template <int D>
std::vector<double> lumped_areas(const Surface<D>& surface) {
  std::vector<double> out(surface.points.size());
  for (const auto& face : surface.faces) {
    Eigen::Matrix<double, D, D - 1> edge;
    for (int i = 1; i < D; ++i)
      for (int k = 0; k < D; ++k) edge(k, i - 1) = surface.points[face[i]][k] - surface.points[face[0]][k];
    const double area = std::sqrt((edge.transpose() * edge).determinant()) / (D - 1);
    for (const Index v : face) out[v] += area / D;
  }
  return out;
}

}  // namespace signorini::test
