// Engineers' constants of orthotropic material, and the matrix that they make at a place.
#include "core/fem/model/orthotropy.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <cmath>

#include "core/fem/assembly/elastic_matrix.hpp"

namespace signorini::testing {
namespace {

using ::testing::HasSubstr;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr EngineeringConstants spruce{11, 0.8, 0.5, 0.37, 0.42, 0.47, 0.7, 0.65, 0.04};

Matrix6 compliance(const EngineeringConstants& c) {
  Matrix6 S = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) S(i, i) = 1 / c[static_cast<std::size_t>(i)];
  S(0, 1) = S(1, 0) = -c[3] / c[0];
  S(0, 2) = S(2, 0) = -c[4] / c[0];
  S(1, 2) = S(2, 1) = -c[5] / c[1];
  S(3, 3) = 1 / c[6], S(4, 4) = 1 / c[8], S(5, 5) = 1 / c[7];  // 12, 23, 13
  return S;
}

TEST(Orthotropy, StiffnessInvertsTheCompliance) {
  for (const double unit : {1.0, 1e-150, 1e150}) {
    EngineeringConstants c = spruce;
    for (const std::size_t k : {0, 1, 2, 6, 7, 8}) c[k] *= unit;
    EXPECT_EQ(complaint(c), "");
    const auto C = stiffness_of(c);
    EXPECT_LT((Eigen::Map<const Matrix6>(C.data()) * compliance(c) - Matrix6::Identity()).norm(), 1e-13) << unit;
  }
}

TEST(Orthotropy, EqualConstantsAreIsotropic) {
  const double E = 7, nu = 0.3, G = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  const EngineeringConstants c{E, E, E, nu, nu, nu, G, G, G};
  const auto C = stiffness_of(c);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(C[6 * i + j], (i < 3 && j < 3 ? lambda : 0) + (i != j ? 0 : i < 3 ? 2 * G : G), 1e-13);
  EXPECT_NEAR(mean_constants(c).young, E, 1e-13);
  EXPECT_NEAR(mean_constants(c).poisson, nu, 1e-14);
}

TEST(Orthotropy, ConstantsOfNoMaterialAreNamed) {
  EngineeringConstants c = spruce;
  c[7] = 0;
  EXPECT_THAT(complaint(c), HasSubstr("G13 is 0"));
  c = spruce;
  c[5] = 1.3;  // more than sqrt(E2 / E3)
  EXPECT_THAT(complaint(c), HasSubstr("nu23 is 1.3"));
  EXPECT_THAT(complaint({1, 1, 1, 0.6, 0.6, 0.6, 1, 1, 1}), HasSubstr("the determinant"));
  EXPECT_EQ(complaint({1, 1, 1, 0.49, 0.49, 0.49, 1, 1, 1}), "");
  EXPECT_NE(complaint({1, 1, 1, NAN, 0.1, 0.1, 1, 1, 1}), "");
}

// The energy of a strain does not know of axes: seen from the material's directions it is that of the turned strain.
TEST(OrthotropicLaw, TurnsWithItsAxes) {
  const double a = 0.5, c = std::cos(a), s = std::sin(a);
  Model<3> model;
  model.first_region = 0;
  model.orthotropic = {
      std::make_shared<const Orthotropy<3>>(Orthotropy<3>{spruce, {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}}), nullptr};
  const OrthotropicLaw<3> law(model);
  EXPECT_TRUE(law.acts_in(0));
  EXPECT_FALSE(law.acts_in(1));
  EXPECT_TRUE(law.constant());
  const ElasticMatrix<3> C = law.at({.region = 0});
  const auto own = stiffness_of(spruce);
  const double xx = 0.3, yy = -0.2, xy = 0.15;  // of the tensor
  const StrainVector<3> strain{xx, yy, 0, 2 * xy, 0, 0};
  const double o11 = c * c * xx + 2 * c * s * xy + s * s * yy, o22 = s * s * xx - 2 * c * s * xy + c * c * yy,
               o12 = c * s * (yy - xx) + (c * c - s * s) * xy;
  const StrainVector<3> turned{o11, o22, 0, 2 * o12, 0, 0};
  const auto energy = [](const ElasticMatrix<3>& matrix, const StrainVector<3>& of) {
    const StrainVector<3> stress = product<3>(matrix, of);
    double out = 0;
    for (std::size_t i = 0; i < 6; ++i) out += stress[i] * of[i];
    return out;
  };
  EXPECT_NEAR(energy(C, strain), energy(own, turned), 1e-13);
}

}  // namespace
}  // namespace signorini::testing
