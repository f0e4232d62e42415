#pragma once
#include <Eigen/Core>

namespace signorini {

/// The symmetric stress of lowest order of Johnson and Mercier (1978; in space Krizek 1982) on a simplex: linear on
/// each of the D + 1 parts that joining the faces to the centroid makes, with tractions that go on across the faces
/// between them. It is the only one with given linear tractions at the faces and a given constant divergence, where
/// these are in equilibrium: so a matrix gives it, which is that of the reference simplex, as tau = F tau^ F' / J^2 for
/// x = F x^.
template <int D>
struct SplitStress {
  static constexpr int parts = D + 1;                 ///< part s is that at the face opposite to vertex s
  static constexpr int components = D * (D + 1) / 2;  ///< xx, xy, (xz,) yy, ...: row by row of the upper triangle
  static constexpr int stresses = parts * (D + 1) * components;
  static constexpr int tractions = parts * D * D;
  static constexpr int data = tractions + D;

  using Operator = Eigen::Matrix<double, stresses, data>;

  /// Rows: components at point q of part s, the vertex q, or the centroid for q = s. Columns: component i at the k-th
  /// of the vertices of the face opposite to s, times its area; then the force.
  static int row(int s, int q, int component) { return (s * (D + 1) + q) * components + component; }
  static int column(int s, int k, int i) { return (s * D + k) * D + i; }
  static constexpr int component(int i, int j) { return i <= j ? i * D - i * (i - 1) / 2 + j - i : component(j, i); }

  static const Operator& reference();
};

}  // namespace signorini
