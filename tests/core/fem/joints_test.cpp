// Loads in total, and what changes of unknowns make of parts of bodies: ties and rigid parts.
#include <gmock/gmock.h>

#include "core/fem/assembly/resultant.hpp"
#include "core/fem/elements/across.hpp"
#include "core/fem/elements/integrate.hpp"
#include "core/fem/motions/deciding_rows.hpp"
#include "core/fem/pairs/rigid_parts.hpp"
#include "core/fem/pairs/tied_sides.hpp"
#include "core/fem/recovery/beside_slaves.hpp"
#include "core/fem/recovery/rigid_motion.hpp"
#include "core/fem/recovery/ties.hpp"
#include "core/mesh/join.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

template <int D>
void expect_integrals() {
  const Mesh<D> mesh = distorted_mesh<D>(3);
  const Nodes<D> nodes(mesh);
  double area = 0, volume = 0, shares = 0, height = 0;
  integrate_faces<D, 1>(nodes, Plane::strain, select_faces(mesh, Selection{"top", {}, ""}, 1), false,
                        [&](const auto& point) {
                          area += point.weight;
                          for (const double value : point.value) shares += point.weight * value;
                          EXPECT_NEAR(point.normal[D - 1], 1, 1e-14);
                          EXPECT_NEAR(point.x[D - 1], 1, 1e-14);
                        });
  integrate_elements<D, 1>(nodes, Plane::strain, {-1, -1}, false, [&](const auto& point) {
    volume += point.weight;
    height += point.weight * point.x[D - 1];
  });
  EXPECT_NEAR(area, 1, 1e-13);
  EXPECT_NEAR(shares, 1, 1e-13);
  EXPECT_NEAR(volume, 1, 1e-13);
  EXPECT_NEAR(height, 0.5, 1e-13);
}

TEST(Integrate, OfUnitMeshes) {
  expect_integrals<2>();
  expect_integrals<3>();
}

TEST(Integrate, OfABodyOfRevolutionCirclesCount) {
  double area = 0;
  const Mesh<2> mesh = unit_mesh<2>(4);
  integrate_faces<2, 1>(Nodes<2>(mesh), Plane::axisymmetric, select_faces(mesh, Selection{"top", {}, ""}, 1), true,
                        [&](const auto& point) { area += point.weight; });
  EXPECT_NEAR(area, std::numbers::pi, 1e-13);
}

// A force of 3, 5 and a moment of 7 about the corner (0, 0), on the side x = 1 of the unit square.
TEST(Resultant, ForcesAtNodesSumToIt) {
  const Mesh<2> mesh = unit_mesh<2>(4);
  const Nodes<2> nodes(mesh);
  Model<2> model;
  Load<2> load{Selection{"right", {}, "load.0"}, {}};
  load.total = Resultant<2>{{3, 5}, {7}, std::array<double, 2>{0, 0}, "load.0"};
  model.loads.push_back(load);
  std::array<double, 2> force{};
  double moment = 0;
  const std::vector<double> b = load_vector<2, 2>(nodes, model);
  for (Index p = 0; p < nodes.size(); ++p) {
    for (int i = 0; i < 2; ++i) force[i] += b[2 * p + i];
    moment += nodes.at(p)[0] * b[2 * p + 1] - nodes.at(p)[1] * b[2 * p];
  }
  EXPECT_NEAR(force[0], 3, 1e-12);
  EXPECT_NEAR(force[1], 5, 1e-12);
  EXPECT_NEAR(moment, 7, 1e-12);
  const Load<2> spread = distributed<2, 2>(nodes, model, load);
  EXPECT_NEAR(spread.value[0](site<2>({1, 0.5}, 1)), 3, 1e-12);
}

TEST(Across, WhatMeetsAPlaneGoesOnBeyondIt) {
  Mesh<2> mesh = unit_mesh<2>(3);
  mesh.mirrors = {{0, 0.0}, {1, 0.0}};
  const Nodes<2> nodes(mesh);
  EXPECT_EQ(all_planes(mesh), 3u);
  EXPECT_EQ(planes_across<2>(nodes, Selection{"top", {}, ""}, 1), 1u);
  EXPECT_EQ(planes_across<2>(nodes, Selection{"right", {}, ""}, 1), 2u);
  EXPECT_EQ(planes_across<2>(nodes, {}, 1), 3u);
  EXPECT_EQ(reflected_direction<2>({0, 0.0}, {2, 3}), (Point<2>{-2, 3}));
}

TEST(DecidingRows, LeaveTheirNullSpace) {
  DecidingRows rows(3);
  for (int k = 0; k < 100; ++k) rows.add(Eigen::RowVector3d(1 + k % 3, 2, 0));
  EXPECT_FALSE(rows.complete());
  const Eigen::MatrixXd space = rows.null_space();
  ASSERT_EQ(space.cols(), 1);
  EXPECT_NEAR(std::abs(space(2, 0)), 1, 1e-12);
  for (int k = 0; k < 100; ++k) rows.add(Eigen::RowVector3d(0, k % 2, 1));
  EXPECT_TRUE(rows.complete());
}

// The top of a block turns about its middle: each of its nodes moves as told, and a torque does that.
TEST(RigidParts, TurnAsTheyArePrescribed) {
  const Mesh<2> mesh = unit_mesh<2>(4);
  const Nodes<2> nodes(mesh);
  Model<2> model;
  model.poisson = 0.3;
  model.fixes = {fix<2>("bottom", {Field(0), Field(0)})};
  RigidPart<2> part{Selection{"top", {}, "rigid.0"}, std::array<double, 2>{0.5, 1}};
  part.displacement = {Field(0.0), Field(-0.1)};
  part.rotation = {Field(0.02)};
  model.rigid.push_back(part);
  const auto discrete = discretize<2, 2>(nodes, model);
  const std::vector<double> x = solve_dense(discrete.problem), u = to_global(discrete.problem, x);
  for (Index p = 0; p < nodes.size(); ++p) {
    if (nodes.at(p)[1] != 1) continue;
    EXPECT_NEAR(u[2 * p], 0, 1e-12);
    EXPECT_NEAR(u[2 * p + 1], -0.1 + 0.02 * (nodes.at(p)[0] - 0.5), 1e-12);
  }
  const auto motion = rigid_motions<2>(model, discrete, x);
  ASSERT_EQ(motion.size(), 1u);
  EXPECT_NEAR(motion[0].displacement[1], -0.1, 1e-12);
  EXPECT_NEAR(motion[0].rotation[0], 0.02, 1e-12);
  EXPECT_LT(motion[0].reaction[1], -0.05) << "it is pushed down";
  EXPECT_GT(motion[0].torque[0], 0);

  std::vector<FixedDirections<2>> fixes = collect_fixes<2, 2>(nodes, model);
  hold<2>(nodes, model, discrete.pairs->rigid, fixes);
  EXPECT_TRUE(std::ranges::is_sorted(fixes, {}, &FixedDirections<2>::vertex));
}

/// A block on another one with other cells, glued.
struct Glued {
  Glued() {
    Mesh<2> up = unit_mesh<2>(2);
    for (Point<2>& x : up.points) x[1] += 1;
    mesh = join<2>({unit_mesh<2>(3), std::move(up)}, {"low", "up"}, {0, 0});
    ObstacleTerm<2> tie = term<2>([](const SurfaceVertex&) { return LocalConstraint<2>{}; }, "up/bottom", "obstacle.0");
    tie.other = Selection{"low/top", {}, "obstacle.0"};
    tie.tied = 0.0;
    model.obstacles = {tie};
    model.fixes = {fix<2>("low/bottom", {Field(0), Field(0)}), fix<2>("up/top", {Field(0.0), Field(-0.1)})};
  }
  Mesh<2> mesh;
  Model<2> model;
};

// Without Poisson's ratio the strain is the same all over.
TEST(Ties, CarryTheForceOfAUniformStrain) {
  const Glued glued;
  const Nodes<2> nodes(glued.mesh);
  const auto discrete = discretize<2, 2>(nodes, glued.model);
  const std::vector<double> x = solve_dense(discrete.problem), u = to_global(discrete.problem, x);
  for (Index p = 0; p < nodes.size(); ++p) EXPECT_NEAR(u[2 * p + 1], -0.05 * nodes.at(p)[1], 1e-11);
  const auto ties = tie_forces<2, 2>(nodes, glued.model, discrete, x);
  EXPECT_EQ(ties.size(), 3u);
  std::vector<ContactSummary<2>> sums(1);
  sum_up<2>(ties, sums);
  EXPECT_NEAR(std::abs(sums[0].force[1]), 0.05, 1e-11);
  EXPECT_NEAR(sums[0].area, 1, 1e-11);
}

TEST(Ties, AreNoneAcrossAGap) {
  Glued glued;
  for (Point<2>& x : glued.mesh.points)
    if (x[1] > 1 || (x[1] == 1 && &x - glued.mesh.points.data() >= unit_mesh<2>(3).vertices())) x[1] += 0.3;
  const Nodes<2> nodes(glued.mesh);
  const auto fixes = collect_fixes<2, 2>(nodes, glued.model);
  const PairedFaces faces = paired_faces(glued.mesh, glued.model.obstacles[0], 1);
  EXPECT_THROW(couple_tied<2>(nodes, glued.model, glued.model.obstacles[0], faces, fixes, {}), Error);
}

// Where no other body is beside it, an obstacle's pressures stay as they are.
TEST(BesideSlaves, NothingChangesWithoutThem) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  Model<2> model;
  model.fixes = {fix<2>("top", {Field(0.0), Field(-0.1)})};
  model.obstacles = {term<2>([](const SurfaceVertex&) { return bound<2>({0, 1}, 0, infinity); }, "bottom")};
  const Nodes<2> nodes(mesh);
  const auto discrete = discretize<2, 2>(nodes, model);
  auto contact = contact_state<2, 2>(nodes, model, discrete, solve_bounded(discrete.problem)).nodes;
  const auto before = contact;
  BesideSlaves<2>(nodes, model, discrete, contact).spread();
  for (std::size_t k = 0; k < contact.size(); ++k) EXPECT_EQ(contact[k].pressure, before[k].pressure);
}

}  // namespace
}  // namespace signorini::testing
