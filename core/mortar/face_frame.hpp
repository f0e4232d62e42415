#pragma once
#include "core/base/dot.hpp"
#include "core/mortar/piece.hpp"

namespace signorini::mortar {

/// Coordinates in which a slave face sees the master: K along a plane, and the height along the direction in which it
/// looks. All are in units of the face's longest edge, from its centroid on.
template <int D>
struct FaceFrame {
  static constexpr int K = D - 1;

  Point<D> origin{};
  double size = 0;                 ///< the unit: the longest edge
  Point<D> direction{};            ///< of length 1
  std::array<Point<D>, D> axis;    ///< the K of the plane, then the direction; each over `size`
  std::array<Point<K>, D> corner;  ///< of the slave face, in the plane
  std::array<double, D> corner_height;
  std::array<Affine<K>, D> shape;  ///< its barycentric coordinates
  Affine<K> height;                ///< its height
  double area = 0;                 ///< of what it is in the plane

  FaceFrame() = default;
  FaceFrame(const std::array<Point<D>, D>& at, const Point<D>& look) : direction(look) {
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) origin[k] += at[i][k] / D;
      for (int j = 0; j < i; ++j) size = std::max(size, length<D>(difference<D>(at[i], at[j])));
    }
    set_axes(at);
    for (int i = 0; i < D; ++i) corner_height[i] = map(at[i], corner[i]);
    shape = barycentric<K>(corner);
    for (int i = 0; i < D; ++i) height.add(corner_height[i], shape[i]);
    area = signed_measure<K>(corner);
  }

  /// @return the height of x
  double map(const Point<D>& x, Point<K>& y) const {
    const Point<D> from = difference<D>(x, origin);
    for (int k = 0; k < K; ++k) y[k] = dot(axis[k], from);
    return dot(axis[K], from);
  }

  /// The point at y in the plane, at the height given.
  Point<D> place(const Point<K>& y, double z) const {
    Point<D> x = origin;
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < K; ++k) x[i] += axis[k][i] * size * size * y[k];
      x[i] += axis[K][i] * size * size * z;
    }
    return x;
  }

 private:
  // The first axis is along the first edge, and the face goes round it counterclockwise.
  void set_axes(const std::array<Point<D>, D>& at) {
    Point<D> first = difference<D>(at[1], at[0]);
    const double along = dot(first, direction);
    for (int k = 0; k < D; ++k) first[k] -= along * direction[k];
    const double norm = length<D>(first);
    for (double& c : first) c /= norm;
    axis[0] = first;
    if constexpr (D == 3) axis[1] = cross(direction, first);
    axis[K] = direction;
    for (auto& a : axis)
      for (double& c : a) c /= size;
  }
};

}  // namespace signorini::mortar
