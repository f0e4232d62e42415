#include "core/fem/model/orthotropy.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/rounding.hpp"

namespace signorini {
namespace {

constexpr const char* names[] = {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};

Eigen::Vector3d root_of_moduli(const EngineeringConstants& c) {
  return {std::sqrt(c[0]), std::sqrt(c[1]), std::sqrt(c[2])};
}

/// The compliance of normal strains, times those roots from both sides: ones on the diagonal, whatever the units.
Eigen::Matrix3d scaled_compliance(const EngineeringConstants& c) {
  const Eigen::Vector3d root = root_of_moduli(c);
  Eigen::Matrix3d S;
  S << 1, -c[3] * root[1] / root[0], -c[4] * root[2] / root[0],  //
      -c[3] * root[1] / root[0], 1, -c[5] * root[2] / root[1],   //
      -c[4] * root[2] / root[0], -c[5] * root[2] / root[1], 1;
  return S;
}

}  // namespace

std::string complaint(const EngineeringConstants& c) {
  for (const std::size_t k : {0, 1, 2, 6, 7, 8})
    if (!(c[k] > 0) || !std::isfinite(c[k])) return fmt::format("{} is {}, expected a positive number", names[k], c[k]);
  constexpr std::array<std::array<std::size_t, 2>, 3> directions{{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = c[k + 3], limit = std::sqrt(c[directions[k][0]] / c[directions[k][1]]);
    if (!(std::abs(ratio) < limit))
      return fmt::format("{} is {}, expected less than sqrt({} / {}) = {:.4g}: else there are strains without energy",
                         names[k + 3], ratio, names[directions[k][0]], names[directions[k][1]], limit);
  }
  if (const double determinant = scaled_compliance(c).determinant(); !(determinant > rounding_of_sums))
    return fmt::format(
        "nu12, nu13 and nu23 together leave strains without energy: the determinant 1 - nu12 nu21 - nu13 nu31 - nu23 "
        "nu32 - 2 nu12 nu23 nu31 is {:.3g}, expected a positive number",
        determinant);
  return "";
}

std::array<double, 36> stiffness_of(const EngineeringConstants& c) {
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> C = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>::Zero();
  const Eigen::Vector3d root = root_of_moduli(c);
  const Eigen::Matrix3d normal = root.asDiagonal() * scaled_compliance(c).inverse() * root.asDiagonal();
  C.topLeftCorner<3, 3>() = (normal + normal.transpose()) / 2;
  C(3, 3) = c[6], C(4, 4) = c[8], C(5, 5) = c[7];
  std::array<double, 36> out;
  std::copy_n(C.data(), 36, out.begin());
  return out;
}

IsotropicConstants mean_constants(const EngineeringConstants& c) {
  const double along = 1 / c[0] + 1 / c[1] + 1 / c[2], across = -c[3] / c[0] - c[4] / c[0] - c[5] / c[1],
               shear = 1 / c[6] + 1 / c[7] + 1 / c[8];
  const double bulk = 1 / (along + 2 * across), G = 15 / (4 * along - 4 * across + 3 * shear);
  return {9 / (3 / G + 1 / bulk), (3 * bulk - 2 * G) / (2 * (3 * bulk + G))};
}

}  // namespace signorini
