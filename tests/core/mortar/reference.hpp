#pragma once
#include <map>

#include "core/base/dense.hpp"
#include "core/mesh/quadrature.hpp"
#include "tests/core/mortar/surfaces.hpp"

/// The coupling once more, by other means: overlaps from the crossings of edges, integrals by a quadrature rule, dual
/// functions from the matrices of each face, dense and in the basis of the nodes. Every slave face is tried with every
/// master face.
namespace signorini::test {

template <int D>
struct ReferenceNode {
  double weight = 0, gap = 0;
  Eigen::Matrix<double, D, 1> normal = Eigen::Matrix<double, D, 1>::Zero();  ///< its length is no more than the weight
  std::map<Index, double> row;                                               ///< times the weight
  double condition = 1;                                                      ///< of the worst matrix of its faces
};

template <int D>
class Reference {
 public:
  static constexpr int K = D - 1;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Flat = Eigen::Matrix<double, K, 1>;
  using Square = Eigen::Matrix<double, D, D>;

  std::map<Index, ReferenceNode<D>> nodes;

  Reference(const Surface<D>& slave, const Surface<D>& master) : slave_(slave), master_(master) {
    for (const auto& face : slave.faces) add(face);
    for (auto& [p, node] : nodes) {
      for (auto& [q, value] : node.row) value /= node.weight;
      node.gap /= std::max(node.normal.norm(), node.weight / 2);
      node.normal.normalize();
    }
  }

 private:
  static Vector point(const Surface<D>& s, Index v) { return Eigen::Map<const Vector>(s.points[v].data()); }

  static Vector normal(const std::array<Vector, D>& x) {
    if constexpr (D == 2) {
      const Vector e = x[1] - x[0];
      return Vector(e[1], -e[0]).normalized();
    } else {
      return (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    }
  }

  // Barycentric coordinates of y in a simplex.
  static Vector coordinates(const std::array<Flat, D>& corner, const Flat& y) {
    Square m;
    Vector right;
    for (int i = 0; i < D; ++i) m.col(i) << corner[i], 1;
    right << y, 1;
    return m.inverse() * right;
  }

  static bool inside(const std::array<Flat, D>& corner, const Flat& y) {
    return coordinates(corner, y).minCoeff() >= -1e-13;
  }

  // Corners of the overlap of two simplices, in order.
  static std::vector<Flat> overlap(const std::array<Flat, D>& a, const std::array<Flat, D>& b) {
    std::vector<Flat> out;
    for (const Flat& y : a)
      if (inside(b, y)) out.push_back(y);
    for (const Flat& y : b)
      if (inside(a, y)) out.push_back(y);
    if constexpr (K == 1) {
      std::sort(out.begin(), out.end(), [](const Flat& x, const Flat& y) { return x[0] < y[0]; });
      if (out.size() > 2) out = {out.front(), out.back()};
      return out;
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const Flat u = a[(i + 1) % 3] - a[i], v = b[(j + 1) % 3] - b[j], w = b[j] - a[i];
          const double det = u[0] * v[1] - u[1] * v[0];
          if (std::abs(det) < 1e-14 * u.norm() * v.norm()) continue;
          const double s = (w[0] * v[1] - w[1] * v[0]) / det, t = (w[0] * u[1] - w[1] * u[0]) / det;
          if (s >= 0 && s <= 1 && t >= 0 && t <= 1) out.push_back(a[i] + s * u);
        }
      Flat middle = Flat::Zero();
      for (const Flat& y : out) middle += y / static_cast<double>(out.size());
      std::sort(out.begin(), out.end(), [&](const Flat& x, const Flat& y) {
        return std::atan2(x[1] - middle[1], x[0] - middle[0]) < std::atan2(y[1] - middle[1], y[0] - middle[0]);
      });
      return out;
    }
  }

  // Calls visit(y, weight) for the points of a rule on each simplex of the overlap.
  template <class Visit>
  static void integrate(const std::vector<Flat>& corner, const Visit& visit) {
    for (std::size_t i = K; i < corner.size(); ++i) {
      std::array<Flat, D> simplex;
      simplex[0] = corner[0];
      for (int k = 1; k < D; ++k) simplex[k] = corner[i - K + k];
      Eigen::Matrix<double, K, K> edges;
      for (int k = 0; k < K; ++k) edges.col(k) = simplex[k + 1] - simplex[0];
      const double size = std::abs(edges.determinant()) / K;
      for (const auto& q : quadrature5<K>()) {
        Flat y = Flat::Zero();
        for (int k = 0; k < D; ++k) y += q.barycentric[k] * simplex[k];
        visit(y, q.weight * size);
      }
    }
  }

  void add(const std::array<Index, D>& face) {
    std::array<Vector, D> x;
    for (int i = 0; i < D; ++i) x[i] = point(slave_, face[i]);
    const Vector n = normal(x);
    // Any basis of the plane across n.
    Eigen::Matrix<double, D, D> any = Eigen::Matrix<double, D, D>::Identity();
    any.col(0) = n;
    if (std::abs(n[0]) < 0.5) any.col(1) = Vector::Unit(0);
    const Eigen::Matrix<double, D, K> across = orthonormal_columns(any).template rightCols<K>();
    std::array<Flat, D> corner;
    for (int i = 0; i < D; ++i) corner[i] = across.transpose() * (x[i] - x[0]);

    Vector weight = Vector::Zero(), gap = Vector::Zero();
    Square mass = Square::Zero();
    std::map<Index, Vector> rows;
    for (const auto& other : master_.faces) {
      std::array<Vector, D> z;
      std::array<Flat, D> shadow;
      for (int i = 0; i < D; ++i) z[i] = point(master_, other[i]), shadow[i] = across.transpose() * (z[i] - x[0]);
      if (normal(z).dot(n) > -0.5) continue;
      integrate(overlap(corner, shadow), [&](const Flat& y, double w) {
        const Vector phi = coordinates(corner, y), chi = coordinates(shadow, y);
        weight += w * phi;
        mass += w * phi * phi.transpose();
        double distance = 0;
        for (int i = 0; i < D; ++i) distance += chi[i] * (z[i] - x[0]).dot(n);
        gap += w * distance * phi;
        for (int i = 0; i < D; ++i) {
          auto [at, fresh] = rows.try_emplace(other[i], Vector::Zero());
          at->second += w * chi[i] * phi;
        }
      });
    }
    if (!(weight.sum() > 0)) return;
    const Square dual = weight.asDiagonal() * mass.inverse();
    const Eigen::VectorXd singular = singular_values(mass);
    const Vector gaps = dual * gap;
    for (int p = 0; p < D; ++p) {
      ReferenceNode<D>& node = nodes[face[p]];
      node.weight += weight[p];
      node.gap += gaps[p];
      node.normal += weight[p] * n;
      node.condition = std::max(node.condition, singular[0] / singular[D - 1]);
      for (const auto& [q, value] : rows) node.row[q] += dual.row(p).dot(value);
    }
  }

  const Surface<D>& slave_;
  const Surface<D>& master_;
};

}  // namespace signorini::test
