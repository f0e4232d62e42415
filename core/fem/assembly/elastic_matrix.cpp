#include "core/fem/assembly/elastic_matrix.hpp"

#include <Eigen/Dense>

#include "core/fem/conditions/directions.hpp"
#include "core/fem/model/material.hpp"
#include "core/fem/model/orthotropy.hpp"

namespace signorini {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr std::array<std::array<int, 2>, 6> index{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// T with strain along the rows of R = T strain in space.
Matrix6 turn(const Eigen::Matrix3d& R) {
  Matrix6 T;
  for (int j = 0; j < 6; ++j) {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    const auto [a, b] = index[static_cast<std::size_t>(j)];
    strain(a, b) = strain(b, a) = a == b ? 1 : 0.5;
    const Eigen::Matrix3d own = R * strain * R.transpose();
    for (int i = 0; i < 6; ++i) {
      const auto [c, d] = index[static_cast<std::size_t>(i)];
      T(i, j) = c == d ? own(c, d) : 2 * own(c, d);
    }
  }
  return T;
}

/// Nothing holds the body across the plane.
void free_across(Matrix6& C) {
  const Eigen::Matrix<double, 6, 1> column = C.col(2);
  C -= column * column.transpose() / column[2];
  C.row(2).setZero();
  C.col(2).setZero();
}

}  // namespace

template <int D>
OrthotropicLaw<D>::OrthotropicLaw(const Model<D>& model) : model_(model) {
  for (const auto& material : model.orthotropic) {
    Fixed& fixed = matrix_.emplace_back();
    if (!material) continue;
    fixed.own = stiffness_of(material->constants);
    if (material->frame.kind == Frame::cylindrical)
      constant_ = false;
    else
      fixed.matrix = turned(fixed.own, material->axes);
  }
}

template <int D>
ElasticMatrix<D> OrthotropicLaw<D>::turned(const std::array<double, 36>& own,
                                           const std::array<std::array<double, 3>, 3>& axes) const {
  Eigen::Matrix3d R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = axes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Matrix6 T = turn(R);
  Matrix6 C = T.transpose() * Eigen::Map<const Matrix6>(own.data()) * T;
  if (has_plane_stress(model_)) free_across(C);
  ElasticMatrix<D> out;
  constexpr std::size_t n = strain_components<D>;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      out[i * n + j] = (C(a, b) + C(b, a)) / 2;
    }
  return out;
}

template <int D>
ElasticMatrix<D> OrthotropicLaw<D>::at(const Site& site) const {
  const Orthotropy<D>& material = *of(site.region);
  const Fixed& fixed = matrix_[number(site.region)];
  if (material.frame.kind != Frame::cylindrical) return fixed.matrix;
  Point<D> x;
  std::copy_n(site.x, D, x.begin());
  const auto direction = directions<D, D>(material.frame, x, {});
  std::array<std::array<double, 3>, 3> axes{{{}, {}, {0, 0, 1}}};
  for (std::size_t k = 0; k < D; ++k) std::ranges::copy(direction[k], axes[k].begin());
  return turned(fixed.own, axes);
}

template class OrthotropicLaw<2>;
template class OrthotropicLaw<3>;

}  // namespace signorini
