#pragma once
#include <algorithm>

#include "core/mesh/simplex.hpp"

/// Affine functions, convex pieces and their moments in the K dimensions of a face.
namespace signorini::mortar {

/// at + slope'y
template <int K>
struct Affine {
  double at = 0;
  Point<K> slope{};

  double operator()(const Point<K>& y) const {
    double value = at;
    for (int k = 0; k < K; ++k) value += slope[k] * y[k];
    return value;
  }
  Affine operator-() const {
    Affine out{-at, slope};
    for (double& s : out.slope) s = -s;
    return out;
  }
  void add(double factor, const Affine& other) {
    at += factor * other.at;
    for (int k = 0; k < K; ++k) slope[k] += factor * other.slope[k];
  }
};

/// The barycentric coordinates of a simplex, whatever its orientation.
template <int K>
std::array<Affine<K>, K + 1> barycentric(const std::array<Point<K>, K + 1>& corner) {
  std::array<Affine<K>, K + 1> out;
  const Point<K>& a = corner[0];
  if constexpr (K == 1) {
    out[1].slope = {1 / (corner[1][0] - a[0])};
  } else {
    const Point<2> b = difference<2>(corner[1], a), c = difference<2>(corner[2], a);
    const double s = 1 / (b[0] * c[1] - b[1] * c[0]);
    out[1].slope = {c[1] * s, -c[0] * s};
    out[2].slope = {-b[1] * s, b[0] * s};
  }
  out[0].at = 1;
  for (int i = 1; i <= K; ++i) {
    out[i].at = -out[i](a);
    out[0].add(-1, out[i]);
  }
  return out;
}

/// A segment (K = 1) or a convex polygon.
template <int K>
struct Piece {
  /// Of a triangle cut by three lines six in theory; where rounding makes it not quite convex each cut may add more.
  static constexpr int most = K == 1 ? 2 : 9;
  int count = 0;
  std::array<Point<K>, most> corner;

  Piece() = default;
  explicit Piece(const std::array<Point<K>, K + 1>& simplex) : count(K + 1) {
    std::copy(simplex.begin(), simplex.end(), corner.begin());
  }
  bool empty() const { return count <= K; }
};

/// What is left of a piece where f >= 0 (Sutherland, Hodgman: Reentrant polygon clipping, 1974).
template <int K>
Piece<K> clipped(const Piece<K>& piece, const Affine<K>& f) {
  Piece<K> out;
  std::array<double, Piece<K>::most> value;
  for (int i = 0; i < piece.count; ++i) value[i] = f(piece.corner[i]);
  const int edges = K == 1 ? 1 : piece.count;
  for (int i = 0; i < piece.count; ++i) {
    if (value[i] >= 0) out.corner[out.count++] = piece.corner[i];
    const int j = i + 1 == piece.count ? 0 : i + 1;
    if (i >= edges || (value[i] < 0) == (value[j] < 0)) continue;
    const double s = value[i] / (value[i] - value[j]);
    for (int k = 0; k < K; ++k)
      out.corner[out.count][k] = piece.corner[i][k] + s * (piece.corner[j][k] - piece.corner[i][k]);
    ++out.count;
  }
  if (out.empty()) out.count = 0;
  return out;
}

/// Calls visit(simplex) for simplices that make up a piece.
template <int K, class Visit>
void each_simplex(const Piece<K>& piece, const Visit& visit) {
  if constexpr (K == 1) {
    if (!piece.empty()) visit(std::array<Point<1>, 2>{piece.corner[0], piece.corner[1]});
  } else {
    for (int i = 2; i < piece.count; ++i)
      visit(std::array<Point<2>, 3>{piece.corner[0], piece.corner[i - 1], piece.corner[i]});
  }
}

template <int K>
double signed_measure(const std::array<Point<K>, K + 1>& corner) {
  if constexpr (K == 1)
    return corner[1][0] - corner[0][0];
  else
    return signed_volume<2>(corner);
}

/// Coordinates with an origin and orthonormal axes of their own.
template <int K>
struct Axes {
  Point<K> origin{};
  std::array<Point<K>, K> axis = unit();

  static constexpr std::array<Point<K>, K> unit() {
    std::array<Point<K>, K> e{};
    for (int k = 0; k < K; ++k) e[k][k] = 1;
    return e;
  }
  Point<K> of(const Point<K>& y) const {
    Point<K> out{};
    for (int k = 0; k < K; ++k)
      for (int i = 0; i < K; ++i) out[k] += axis[k][i] * (y[i] - origin[i]);
    return out;
  }
  Affine<K> of(const Affine<K>& f) const {
    Affine<K> out{f(origin), {}};
    for (int k = 0; k < K; ++k)
      for (int i = 0; i < K; ++i) out.slope[k] += axis[k][i] * f.slope[i];
    return out;
  }
};

/// The integrals of 1, y and yy'.
template <int K>
struct Moments {
  double measure = 0;
  Point<K> first{};
  std::array<Point<K>, K> second{};

  void add(const std::array<Point<K>, K + 1>& simplex) {
    const double a = signed_measure<K>(simplex);
    Point<K> sum{};
    for (const Point<K>& y : simplex)
      for (int k = 0; k < K; ++k) sum[k] += y[k];
    measure += a;
    for (int k = 0; k < K; ++k) {
      first[k] += a / (K + 1) * sum[k];
      for (int j = 0; j < K; ++j) {
        double products = sum[j] * sum[k];
        for (const Point<K>& y : simplex) products += y[j] * y[k];
        second[j][k] += a / ((K + 1) * (K + 2)) * products;
      }
    }
  }
  void add(const Moments& other) {
    measure += other.measure;
    for (int k = 0; k < K; ++k) {
      first[k] += other.first[k];
      for (int j = 0; j < K; ++j) second[k][j] += other.second[k][j];
    }
  }
};

/// Those of a piece in other coordinates: of pieces far smaller than their face they are exact about the middle only.
template <int K>
Moments<K> moments(Piece<K> piece, const Axes<K>& axes = {}) {
  for (int i = 0; i < piece.count; ++i) piece.corner[i] = axes.of(piece.corner[i]);
  Moments<K> out;
  each_simplex(piece, [&](const std::array<Point<K>, K + 1>& simplex) { out.add(simplex); });
  return out;
}

template <int K>
double measure(const Piece<K>& piece) {
  double sum = 0;
  each_simplex(piece, [&](const std::array<Point<K>, K + 1>& simplex) { sum += signed_measure<K>(simplex); });
  return sum;
}

}  // namespace signorini::mortar
