#include "core/fem/recovery/contact.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "core/fem/elements/nested.hpp"
#include "core/mesh/refine.hpp"
#include "core/solver/interpolate.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using std::numbers::pi;

// A block pressed by the traction p onto a plane under its bottom, turned in space: uniform stress. Symmetry planes
// hold it sideways. Its sides may touch the plane as well, but do so at edges only.
template <int D>
void expect_flat_punch(bool turned, double gap, const std::string& part) {
  const double p = 0.2;
  Mesh<D> mesh = distorted_mesh<D>(2);
  using Matrix = Eigen::Matrix<double, D, D>;
  const Matrix R = turned ? rotation<D>() : Matrix::Identity();
  if (turned) rotate_mesh(mesh);
  Model<D> model;
  model.poisson = 0.3;
  for (const std::string side : {"left", "front"})
    if (side == "left" || D == 3) {
      model.fixes.push_back(fix<D>(side, {}, Frame::normal));
      model.fixes.back().value[0] = 0;
    }
  Load<D> press{Selection{"top", {}, ""}, {}};
  std::array<double, D> up;
  for (int i = 0; i < D; ++i) {
    up[i] = R(i, D - 1);
    press.value[i] = -p * up[i];
  }
  model.loads.push_back(press);
  const auto plane = [=](const SurfaceVertex& v) {
    return bound<D>(up, -gap - std::inner_product(up.begin(), up.end(), v.position, 0.0), infinity);
  };
  model.obstacles = {term<D>(plane, part)};
  const auto discrete = discretize(mesh, model);
  const auto x = solve_bounded(discrete.problem);
  const auto state = contact_state(mesh, model, discrete, x);
  ASSERT_EQ(state.obstacles.size(), 1u);
  EXPECT_EQ(state.obstacles[0].nodes, D == 2 ? 3 : 12);
  EXPECT_NEAR(state.obstacles[0].area, 1, 1e-13);
  EXPECT_NEAR(state.obstacles[0].max_pressure, p, 1e-11);
  for (int i = 0; i < D; ++i) EXPECT_NEAR(state.obstacles[0].force[i], p * up[i], 1e-12);
  for (const auto& node : state.nodes) {
    for (int i = 0; i < D; ++i) EXPECT_NEAR(node.direction[i], up[i], 1e-15);
    if (!node.contact) {
      EXPECT_GT(node.gap, 0.1);
      continue;
    }
    EXPECT_NEAR(node.pressure, p, 1e-11);
    EXPECT_NEAR(node.gap, 0, 1e-15);
  }
}

TEST(Contact, FlatPunchHasUniformPressure) {
  for (const bool turned : {false, true})
    for (const double gap : {0.0, 0.01})
      for (const char* part : {"bottom", "boundary"}) {
        SCOPED_TRACE(part);
        expect_flat_punch<2>(turned, gap, part);
        expect_flat_punch<3>(turned, gap, part);
      }
}

// A square that stands on a corner, and on a needle's tip: sides at `angle` to the axis, so that their normals are
// 90 degrees less from the obstacle.
TEST(Contact, SidesCountUpTo60DegreesAndAtSharperTipsAllOfThem) {
  const auto area = [](double left, double right) {  // angles between the sides at the tip and the axis, in degrees
    const auto side = [](double angle) { return std::array{std::sin(angle * pi / 180), std::cos(angle * pi / 180)}; };
    Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {1, 1});
    for (Point<2>& x : mesh.points) {
      const auto a = side(-left), b = side(right);
      x = {x[1] * a[0] + x[0] * b[0], x[1] * a[1] + x[0] * b[1]};
    }
    Model<2> model;
    model.fixes = {fix<2>("top", {0.0, -0.1})};
    model.obstacles = {term<2>(
        [](const SurfaceVertex& v) {
          return bound<2>({0, 1}, -v.position[1], infinity);
        },
        "boundary")};
    const auto discrete = discretize(mesh, model);
    const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
    EXPECT_EQ(state.obstacles[0].nodes, 1);
    return state.obstacles[0].area;
  };
  EXPECT_NEAR(area(45, 45), 1, 1e-13);
  EXPECT_NEAR(area(31, 31), 1, 1e-13);
  EXPECT_NEAR(area(20, 70), 0.5, 1e-13);
  EXPECT_NEAR(area(20, 20), 1, 1e-13);
}

// A block whose bottom is guided upwards lies on an incline: the obstacle's whole force is along its normal, though
// only its vertical part is along a free direction.
TEST(Contact, TheWholeForceActsWhereComponentsArePrescribed) {
  const double p = 0.2;
  for (const double slope : {0.0, 0.5, 1.0, -3.0}) {
    const std::array<double, 2> n{-slope / std::hypot(1, slope), 1 / std::hypot(1, slope)};
    Model<2> model;
    model.fixes = {fix<2>("bottom", {0.003, std::nullopt})};
    model.loads = {{Selection{"top", {}, ""}, {0.0, -p}}};
    const double gap = 0.01;
    model.obstacles = {term<2>([&](const SurfaceVertex&) { return bound<2>(n, -gap, infinity); }, "bottom"),
                       term<2>([&](const SurfaceVertex&) { return bound<2>(n, -100 * gap, infinity); }, "left")};
    const Mesh<2> mesh = unit_mesh<2>(3);
    const auto discrete = discretize(mesh, model);
    const auto x = solve_bounded(discrete.problem);
    const auto state = contact_state(mesh, model, discrete, x);
    const auto u = to_global(discrete.problem, x);
    ASSERT_EQ(state.obstacles[0].nodes, 4);
    EXPECT_NEAR(state.obstacles[0].force[0], -slope * p, 1e-12);
    EXPECT_NEAR(state.obstacles[0].force[1], p, 1e-12);
    EXPECT_EQ(state.obstacles[0].undetermined_nodes, 0);
    double sum = 0;
    for (const auto& node : state.nodes) {
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(node.direction[i], n[i], 1e-14);
      sum += node.pressure * node.area;
      const double distance =
          n[0] * u[2 * node.vertex] + n[1] * u[2 * node.vertex + 1] + (node.obstacle == 0 ? gap : 100 * gap);
      EXPECT_NEAR(node.gap, distance, 1e-14);
    }
    EXPECT_NEAR(sum, p / n[1], 1e-12);
  }
}

// Uniform uniaxial stress whose displacements are prescribed on one side: the corner there is held by the side and
// touches the obstacle with half an edge. Or the bottom stands on a support and the obstacle at once.
TEST(Contact, WhatPressesAtHeldVerticesIsTheObstaclesAndIsSaidToBeUndetermined) {
  struct Case {
    double p;
    bool bottom;
    Index held;
  };
  for (const auto& [pressure, bottom, held] : {Case{0.2, false, 1}, Case{0.2, true, 5}, Case{-0.2, true, 0}}) {
    const double nu = 0.3, p = pressure;
    Model<2> model;
    model.poisson = nu;
    const auto along = expression([=](const Site& s) { return p * nu * (1 + nu) * s.x[0]; });
    const auto up = expression([=](const Site& s) { return -p * (1 - nu * nu) * s.x[1]; });
    model.fixes = {fix<2>("left", {along, up})};
    if (bottom) model.fixes.push_back(fix<2>("bottom", {std::nullopt, 0.0}));
    model.loads = {{Selection{"top", {}, ""}, {0.0, -p}}};
    model.obstacles = {term<2>(
        [](const SurfaceVertex& v) {
          return bound<2>({0, 1}, -v.position[1], infinity);
        },
        "boundary")};
    const Mesh<2> mesh = unit_mesh<2>(4);
    const auto discrete = discretize(mesh, model);
    const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
    const ContactSummary<2>& contact = state.obstacles[0];
    EXPECT_NEAR(contact.force[0], 0, 1e-12);
    EXPECT_NEAR(contact.force[1], std::max(p, 0.0), 1e-12);
    EXPECT_EQ(contact.undetermined_nodes, held);
    EXPECT_NEAR(contact.undetermined_force, held == 1 ? p / 8 : held == 5 ? p : 0, 1e-12);
    EXPECT_EQ(contact.nodes, p > 0 ? 5 : 0);
    EXPECT_NEAR(contact.area, p > 0 ? 1 : 0, 1e-12);
    for (const auto& node : state.nodes)
      if (node.contact) {
        EXPECT_NEAR(node.pressure, p, 1e-11);
      }
  }
}

// -u'' = -10 on (0, 1), u >= -psi: by hand, in a strip of squares. The set ends at nodes, between them, or anywhere.
TEST(Contact, ScalarForceBalancesTheLoadOverTheCoincidenceSet) {
  for (const int cells : {20, 21, 22, 23, 24, 27}) {
    SCOPED_TRACE(cells);
    const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {cells, 1});
    Model<1> model;
    model.fixes = {fix<1>("left", {Field(0.0)}), fix<1>("right", {Field(0.0)})};
    model.loads = {{{}, {-10.0}}};
    const double depth = 0.2;  // u = -5 x (2 a - x), a = sqrt(depth / 5) = 0.2, contact on (0.2, 0.8)
    model.obstacles = {term<1>([=](const SurfaceVertex&) { return bound<1>({1}, -depth, infinity); }, {})};
    const auto discrete = discretize(mesh, model);
    const auto x = solve_bounded(discrete.problem);
    const auto state = contact_state(mesh, model, discrete, x);
    EXPECT_NEAR(state.obstacles[0].area, 0.6, 1.0 / (cells * cells));
    EXPECT_NEAR(state.obstacles[0].area, state.obstacles[0].force[0] / 10, 1e-10);
    double volume = 0;
    for (const auto& node : state.nodes) {
      volume += node.area;
      EXPECT_NEAR(node.gap, x[node.vertex] + depth, 1e-15);
      EXPECT_TRUE(node.contact || node.pressure == 0);
    }
    EXPECT_NEAR(volume, 1 - 1.0 / cells, 1e-12);  // without the fixed ends
  }
}

// As rounding leaves it where the solution meets the obstacle without any force.
TEST(Contact, ObstaclesNeverPull) {
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {8, 8});
  for (const double load : {1e-16, -1e-16}) {
    Model<1> model;
    model.loads = {{{}, {load}}};
    model.obstacles = {term<1>([=](const SurfaceVertex&) { return bound<1>({1}, 0, infinity); }, {})};
    const auto discrete = discretize(mesh, model);
    const auto state = contact_state(mesh, model, discrete, std::vector<double>(mesh.points.size(), 0.0));
    for (const auto& node : state.nodes) {
      EXPECT_TRUE(node.contact);
      EXPECT_NEAR(node.pressure, std::max(-load, 0.0), 1e-28);
    }
    EXPECT_NEAR(state.obstacles[0].force[0], std::max(-load, 0.0), 1e-28);
  }
}

TEST(Contact, ForcesGoToTheObstacleThatIsTouched) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<2> model;
  model.poisson = 0.3;
  model.fixes = {fix<2>("left", {0.0, std::nullopt}, Frame::global)};
  Load<2> pull{Selection{"top", {}, ""}, {0.0, 0.3}};
  model.loads = {pull};
  model.obstacles = {term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({0, 1}, -0.01, infinity);
                         },
                         "bottom"),
                     term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({0, 1}, -infinity, 0.02);
                         },
                         "bottom")};
  const auto discrete = discretize(mesh, model);
  const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
  EXPECT_EQ(state.obstacles[0].nodes, 0);
  EXPECT_EQ(state.obstacles[1].nodes, 3);
  EXPECT_NEAR(state.obstacles[1].force[1], -0.3, 1e-12);
  EXPECT_GT(state.obstacles[1].max_pressure, 0);
}

TEST(Nested, InterpolatesLinearFieldsThroughDifferentFrames) {
  const MeshHierarchy<3> meshes = hierarchy(unit_mesh<3>(1), 1);
  const auto linear = [](const Site& s, int i) { return 0.1 * i + s.x[0] - 0.5 * s.x[1] * (i + 1) + 0.3 * s.x[2]; };
  Model<3> model;
  model.fixes = {fix<3>("left", {expression([&](const Site& s) { return linear(s, 0); }), std::nullopt, std::nullopt})};
  model.obstacles = {term<3>(
      [](const SurfaceVertex& v) {
        const Eigen::Vector3d d = Eigen::Vector3d(1 + v.position[1], 2 - v.position[0], 1).normalized();
        return bound<3>({d[0], d[1], d[2]}, -9, 9);
      },
      "bottom")};
  const auto coarse = discretize(meshes.levels[0], model), fine = discretize(meshes.levels[1], model);
  const auto exact = [&](const Mesh<3>& mesh) {
    std::vector<double> u;
    for (const auto& x : mesh.points)
      for (int i = 0; i < 3; ++i) u.push_back(linear({{x[0], x[1], x[2]}, {}, 1}, i));
    return u;
  };
  const Prolongation P = prolongations(meshes)[0];
  EXPECT_EQ(P.coarse, meshes.levels[0].vertices());
  ASSERT_EQ(P.fine(), meshes.levels[1].vertices());
  const auto x = interpolate(coarse.problem, to_local(coarse.problem, exact(meshes.levels[0])), P, fine.problem);
  const auto u = to_global(fine.problem, x), expected = exact(meshes.levels[1]);
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(u[k], expected[k], 1e-14);
}

// An obstacle that bounds two directions at a vertex, along x and along y.
TEST(Contact, NodesOfSeveralDirectionsAreCountedOnce) {
  for (const bool across : {false, true}) {
    Model<2> model;
    model.fixes = {fix<2>("top", {0.05, -0.1})};
    model.obstacles = {term<2>(
        [across](const SurfaceVertex& v) {
          LocalConstraint<2> c = bound<2>({0, 1}, -v.position[1], infinity);
          c.directions = 2;
          c.direction[1][0] = 1;
          c.lower[1] = -infinity;
          c.upper[1] = across ? 0 : 1;
          return c;
        },
        "bottom")};
    const Mesh<2> mesh = unit_mesh<2>(4);
    const auto discrete = discretize(mesh, model);
    const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
    Index entries = 0;
    for (const auto& node : state.nodes) entries += node.contact;
    EXPECT_EQ(state.obstacles[0].nodes, 5);
    EXPECT_LE(state.obstacles[0].area, 1 + 1e-12);
    if (across) {
      EXPECT_GT(entries, 5) << "no test";
    }
  }
}

}  // namespace
}  // namespace signorini::testing
