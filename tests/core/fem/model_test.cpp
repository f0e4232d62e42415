// What a model says of its material, of what stays from one load step to the next, and of obstacles that move.
#include "core/fem/model/model.hpp"

#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/fem/model/material.hpp"
#include "core/fem/model/obstacle_motion.hpp"
#include "core/fem/model/same.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

template <int B>
std::string complaint(const Model<B>& model, const Site& site = {}) {
  try {
    MaterialLaw<B>(model).at(site);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

/// By the modulus along an axis while the others are held, in plane stress while the thickness is free.
template <int B>
void expect_moduli(Plane plane, double E, double nu) {
  Model<B> model;
  model.young = E;
  model.poisson = nu;
  model.plane = plane;
  const Material<B> m = MaterialLaw<B>(model).at({});
  const double held = B == 2 && plane == Plane::stress ? E / (1 - nu * nu) : E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(m.lambda + 2 * m.mu, held, 1e-14 * held);
  EXPECT_NEAR(m.mu, E / (2 * (1 + nu)), 1e-15 * E);
}

TEST(Material, HasTheModuliOfYoungAndPoisson) {
  for (const double nu : {-0.4, 0.0, 0.3, 0.49}) {
    expect_moduli<2>(Plane::strain, 7, nu);
    expect_moduli<2>(Plane::stress, 7, nu);
    expect_moduli<2>(Plane::axisymmetric, 7, nu);
    expect_moduli<3>(Plane::strain, 7, nu);
  }
}

TEST(Material, IsEvaluatedWhereItIsAsked) {
  Model<1> membrane;
  membrane.diffusion = 3;
  EXPECT_TRUE(MaterialLaw<1>(membrane).constant());
  EXPECT_EQ(MaterialLaw<1>(membrane).at({}).diffusion, 3);
  membrane.diffusion = expression([](const Site& s) { return 1 + s.x[0]; });
  EXPECT_FALSE(MaterialLaw<1>(membrane).constant());
  EXPECT_EQ(MaterialLaw<1>(membrane).at(site<2>({4, 0}, 1)).diffusion, 5);
  Model<3> body;
  body.poisson = expression([](const Site&) { return 0.2; });
  EXPECT_FALSE(MaterialLaw<3>(body).constant());  // one expression is enough
}

TEST(Material, OutOfRangeIsRefusedWithOriginValueAndPlace) {
  Model<2> model;
  for (const double nu : {-1.0, 0.5}) {
    model.poisson = nu;
    EXPECT_THAT(complaint(model), HasSubstr("poisson"));
  }
  model.poisson = 0;
  model.young = 0;
  EXPECT_THAT(complaint(model), HasSubstr("young"));
  model.young = expression([](const Site& s) { return s.x[0] - 5; }, "x - 5");
  EXPECT_EQ(complaint(model, site<2>({6, 0}, 1)), "");
  EXPECT_THAT(complaint(model, site<2>({2, 3}, 1)),
              AllOf(HasSubstr("scene.toml:1"), HasSubstr("x - 5"), HasSubstr("-3"), HasSubstr("(2, 3, 0)")));
  Model<1> membrane;
  membrane.diffusion = -1;
  EXPECT_THAT(complaint(membrane), HasSubstr("diffusion"));
}

TEST(Material, NearlyIncompressibleIsSplitBetweenDisplacementsAndPressure) {
  Model<3> model;
  model.pressure = Pressure::linear;
  const auto at = [&](double nu) {
    model.poisson = nu;
    return MaterialLaw<3>(model).at({});
  };
  EXPECT_FALSE(has_pressure(model, at(0.4)));  // that is the limit itself
  EXPECT_TRUE(has_pressure(model, at(0.41)));
  const Material<3> rubber = at(0.499);
  EXPECT_EQ(of_displacements(rubber).mu, rubber.mu);
  EXPECT_EQ(of_displacements(rubber).lambda, lambda_of_displacements * rubber.mu);
  EXPECT_NEAR(of_displacements(rubber).lambda + lambda_of_pressure(rubber), rubber.lambda, 1e-12 * rubber.lambda);
  EXPECT_EQ(lambda_of_pressure(at(0.1)), 0);
  model.pressure = Pressure::none;
  EXPECT_FALSE(has_pressure(model, rubber));
  Model<2> sheet;
  sheet.pressure = Pressure::linear;
  EXPECT_TRUE(has_pressure(sheet, Material<2>{100, 1}));
  sheet.plane = Plane::stress;
  EXPECT_FALSE(has_pressure(sheet, Material<2>{100, 1}));
}

TEST(Model, IsPairedWhereAnObstacleHasTwoSides) {
  Model<2> model;
  EXPECT_FALSE(is_paired(model));
  model.obstacles = {term<2>([](const SurfaceVertex&) { return LocalConstraint<2>{}; }, "bottom")};
  EXPECT_FALSE(is_paired(model));
  model.obstacles.push_back(model.obstacles.front());
  model.obstacles.back().other = Selection{"top", {}, ""};
  EXPECT_TRUE(is_paired(model));
}

Field of_t() {
  return expression([](const Site& s) { return 1 + s.t; }, "1 + t");
}
Field of_x() {
  return {[](const Site& s) { return 1 + s.x[0]; }, "1 + x", "scene.toml:1", false, false};
}

template <int B>
void expect_same_stiffness(Field Model<B>::*coefficient) {
  Model<B> a, b;
  b.t = 2;
  EXPECT_TRUE(same_stiffness(a, b));
  a.*coefficient = b.*coefficient = of_x();
  EXPECT_TRUE(same_stiffness(a, b));
  a.*coefficient = b.*coefficient = of_t();
  EXPECT_FALSE(same_stiffness(a, b));
  b.t = a.t;
  EXPECT_TRUE(same_stiffness(a, b));
  b.*coefficient = of_x();
  EXPECT_FALSE(same_stiffness(a, b));
  b.*coefficient = 0.25;
  EXPECT_FALSE(same_stiffness(a, b));
}

TEST(SameStiffness, DependsOnCoefficientsAsTheyAreAtTheStep) {
  expect_same_stiffness<1>(&Model<1>::diffusion);
  expect_same_stiffness<2>(&Model<2>::young);
  expect_same_stiffness<2>(&Model<2>::poisson);
  expect_same_stiffness<3>(&Model<3>::young);
  expect_same_stiffness<3>(&Model<3>::poisson);
}

TEST(SameStiffness, DependsOnWhatAPlaneMeshStandsFor) {
  Model<2> a, b;
  b.plane = Plane::stress;
  EXPECT_FALSE(same_stiffness(a, b));
  b.plane = a.plane;
  b.pressure = Pressure::linear;
  EXPECT_FALSE(same_stiffness(a, b));
  Model<1> flat, round;
  round.plane = Plane::axisymmetric;
  EXPECT_FALSE(same_stiffness(flat, round));
  round.plane = Plane::stress;  // which a scalar does not know
  EXPECT_TRUE(same_stiffness(flat, round));
  Model<3> body, other;
  other.plane = Plane::stress;  // nor does a body in space
  EXPECT_TRUE(same_stiffness(body, other));
}

template <int B>
void expect_same_loads() {
  Load<B> gravity, pull{Selection{"right", {}, ""}, {}};
  gravity.value.fill(-1);
  pull.value.fill(of_x());
  Model<B> a, b;
  a.loads = b.loads = {gravity, pull};
  b.t = 2;
  EXPECT_TRUE(same_loads(a, b));
  const auto differs = [&](const std::string& what, auto change) {
    Model<B> c = b;
    change(c.loads);
    EXPECT_FALSE(same_loads(a, c)) << what;
  };
  differs("one more", [](auto& loads) { loads.push_back(loads[0]); });
  differs("another order", [](auto& loads) { std::swap(loads[0], loads[1]); });
  differs("value", [](auto& loads) { loads[0].value[B - 1] = 2; });
  differs("of t", [](auto& loads) { loads[1].value[0] = of_t(); });
  differs("part", [](auto& loads) { loads[1].on->part = "left"; });
  differs("where", [](auto& loads) { loads[1].on->where = of_x(); });
  differs("of a volume", [](auto& loads) { loads[1].on.reset(); });
  differs("regions", [](auto& loads) { loads[0].regions = {0, 1}; });
  a.loads[1].on->where = b.loads[1].on->where = of_t();
  EXPECT_FALSE(same_loads(a, b));
  b.t = a.t;
  EXPECT_TRUE(same_loads(a, b));
}

TEST(SameLoads, AreThoseOfTheSameValuesOnTheSameFaces) {
  expect_same_loads<1>();
  expect_same_loads<2>();
  expect_same_loads<3>();
}

// Thermal stress is a load, which the material and the change of temperature make.
TEST(SameLoads, AreThoseOfTheSameThermalStress) {
  Model<2> cold, a;
  cold.young = 2;
  EXPECT_TRUE(same_loads(a, cold)) << "without heat the material is none of a load";
  a.expansion = 1e-3, a.temperature = of_x();
  Model<2> b = a;
  EXPECT_TRUE(same_loads(a, b));
  EXPECT_TRUE(same_stiffness(a, b));
  EXPECT_FALSE(same_loads(a, Model<2>()));
  b.t = 2;
  EXPECT_TRUE(same_loads(a, b));
  const auto differs = [&](auto change) {
    Model<2> c = b;
    change(c);
    EXPECT_FALSE(same_loads(a, c));
  };
  differs([](Model<2>& c) { c.temperature = of_t(); });
  differs([](Model<2>& c) { c.expansion = 2e-3; });
  differs([](Model<2>& c) { c.young = 3; });
  differs([](Model<2>& c) { c.poisson = 0.1; });
  differs([](Model<2>& c) { c.plane = Plane::stress; });
}

/// An obstacle that is where it was put.
class Placed final : public DistanceFunction {
 public:
  Placed(Eigen::Vector3d origin, Eigen::Vector3d axis, bool fails = false) : fails_(fails) {
    Eigen::Map<Eigen::Vector3d>(at_.origin) = origin;
    Eigen::Map<Eigen::Vector3d>(at_.axis) = axis;
  }
  Distance at(const double*, const double*, Status&) const noexcept override { return {}; }
  void place(const double*, const double*, Placement& out, Status& status) const noexcept override {
    out = at_;
    if (fails_) status.fail(2, "is nowhere");
  }

 private:
  Placement at_;
  bool fails_;
};

template <int B>
Eigen::Matrix<double, B, 1> motion(const Placed& before, const Placed& now, const Eigen::Vector3d& x) {
  ObstacleTerm<B> term;
  term.shape_before = std::make_shared<Placed>(before);
  term.shape = std::make_shared<Placed>(now);
  SurfaceVertex vertex{};
  Eigen::Map<Eigen::Vector3d>(vertex.position) = x;
  Status status;
  const auto out = obstacle_motion(term, vertex, status);
  EXPECT_TRUE(status.ok());
  return Eigen::Map<const Eigen::Matrix<double, B, 1>>(out.data());
}

TEST(ObstacleMotion, IsThatOfARigidBodyWhichTurnsTheShortestWay) {
  const Eigen::Vector3d from(0.3, -0.2, 0.7), to(1.1, 0.4, 0.2), x(2, -1, 0.5);
  const Eigen::Vector3d a = Eigen::Vector3d(1, 2, -1).normalized(), b = Eigen::Vector3d(-0.5, 1, 2).normalized();
  const Eigen::Vector3d axis = a.cross(b);
  const Eigen::Matrix3d K{{0, -axis[2], axis[1]}, {axis[2], 0, -axis[0]}, {-axis[1], axis[0], 0}};
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity() + K + K * K / (1 + a.dot(b));
  EXPECT_LT((motion<3>({from, a}, {to, b}, x) - (to + R * (x - from) - x)).norm(), 1e-14);
  EXPECT_LT((motion<3>({from, a}, {to, a}, x) - (to - from)).norm(), 1e-15);
  EXPECT_LT((motion<3>({from, {0, 0, 0}}, {to, {0, 0, 0}}, x) - (to - from)).norm(), 1e-15);  // a ball has no axis
  EXPECT_LT((motion<3>({from, a}, {to, -a}, x) - (to - from)).norm(), 1e-15);                 // no way is the shortest
  const Eigen::Vector3d flat(0.4, 0.9, 0), about(1, 1, 0), right(1, 0, 0), turned(std::cos(0.7), std::sin(0.7), 0);
  const Eigen::Vector2d wanted = rotation<2>() * (flat - about).head<2>() - (flat - about).head<2>();
  EXPECT_LT((motion<2>({about, right}, {about, turned}, flat) - wanted).norm(), 1e-14);
}

TEST(ObstacleMotion, IsZeroWhereTheLastStepIsNotKnown) {
  ObstacleTerm<3> term;
  SurfaceVertex vertex{};
  Status status;
  term.shape = std::make_shared<Placed>(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(obstacle_motion(term, vertex, status), (Point<3>{}));
  EXPECT_TRUE(status.ok());
  term.shape_before = std::make_shared<Placed>(Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 0, 1), true);
  EXPECT_EQ(obstacle_motion(term, vertex, status), (Point<3>{}));
  EXPECT_FALSE(status.ok());
}

}  // namespace
}  // namespace signorini::testing
