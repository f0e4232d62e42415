// The motions that prescribed values leave free, counted by hand.
#include "core/fem/motions/rigid_motions.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/fem/motions/mean_turn.hpp"
#include "support.hpp"

namespace signorini::testing {
namespace {

/// A fix of a named part of the unit square or cube; components to hold.
template <int D>
Fix<D> hold(const std::string& part, const std::vector<int>& components, Frame frame = Frame::global) {
  Fix<D> fix{{part, {}, "fix"}, {}, frame};
  for (const int k : components) fix.value[k] = 0.01;
  return fix;
}

template <int D>
Eigen::MatrixXd free_motions(const Mesh<D>& mesh, std::vector<Fix<D>> fixes) {
  Model<D> model;
  model.fixes = std::move(fixes);
  return RigidMotions<D, D>(Nodes(mesh)).free(discretize<D, D>(mesh, model).problem);
}

template <int D>
std::vector<std::string> names(const Mesh<D>& mesh, std::vector<Fix<D>> fixes) {
  const Nodes nodes(mesh);
  const RigidMotions<D, D> motions(nodes);
  std::vector<std::string> out;
  for (const auto& motion : motions.simple_basis(free_motions<D>(mesh, std::move(fixes))))
    out.push_back(motions.describe(motion));
  return out;
}

using Names = std::vector<std::string>;

TEST(RigidMotions, AreNamedIn2D) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  EXPECT_EQ(names<2>(mesh, {}),
            (Names{"translation along (1, 0)", "translation along (0, 1)", "rotation about (0.5, 0.5)"}));
  EXPECT_EQ(names<2>(mesh, {hold<2>("top", {1})}), (Names{"translation along (1, 0)"}));
  EXPECT_EQ(names<2>(mesh, {hold<2>("left", {0})}), (Names{"translation along (0, 1)"}));
  EXPECT_TRUE(names<2>(mesh, {hold<2>("top", {0, 1})}).empty());
  EXPECT_TRUE(names<2>(mesh, {hold<2>("top", {1}), hold<2>("left", {0})}).empty());
}

TEST(RigidMotions, AreNamedIn3D) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  EXPECT_EQ(names<3>(mesh, {}).size(), 6u);
  EXPECT_EQ(names<3>(mesh, {hold<3>("bottom", {2})}),
            (Names{"translation along (1, 0, 0)", "translation along (0, 1, 0)",
                   "rotation about the axis through (0.5, 0.5, 0.5) along (0, 0, 1)"}));
  EXPECT_EQ(names<3>(mesh, {hold<3>("bottom", {2}), hold<3>("left", {0})}), (Names{"translation along (0, 1, 0)"}));
}

// A plate's edge is held: it turns about that.
TEST(RigidMotions, TurnAboutWhatIsHeld) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  DiscreteProblem<3> problem;
  problem.fixed.assign(mesh.points.size(), 0);
  for (Index p = 0; p < mesh.vertices(); ++p)
    if (mesh.points[p][0] == 0 && mesh.points[p][2] == 1) problem.fixed[p] = 7;
  const Nodes nodes(mesh);
  const RigidMotions<3, 3> motions(nodes);
  const auto basis = motions.simple_basis(motions.free(problem));
  ASSERT_EQ(basis.size(), 1u);
  EXPECT_EQ(motions.describe(basis[0]), "rotation about the axis through (0, 0.5, 1) along (0, 1, 0)");
}

TEST(RigidMotions, TurnAboutAFarAxisIsATranslation) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  const Nodes nodes(mesh);
  const RigidMotions<2, 2> motions(nodes);
  EXPECT_EQ(motions.describe(Eigen::Vector3d(1, 0, 1e-4)), "translation along (1, 0)");
  EXPECT_EQ(motions.describe(Eigen::Vector3d(1, 0, 0.01)), "rotation about (0.5, 50.5)");
}

TEST(RigidMotions, AreLeftFreeWhateverPlaceScaleAndFrame) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double far : {0.0, 1e3}) {
      Mesh<3> mesh = unit_mesh<3>(2);
      rotate_mesh(mesh);
      for (Point<3>& x : mesh.points)
        for (double& c : x) c = scale * (c + far);
      EXPECT_EQ(free_motions<3>(mesh, {}).cols(), 6);
      EXPECT_EQ(free_motions<3>(mesh, {hold<3>("bottom", {0}, Frame::normal)}).cols(), 3);
      EXPECT_EQ(free_motions<3>(mesh, {hold<3>("bottom", {0, 1, 2}, Frame::normal)}).cols(), 0);
    }
}

// They have no energy, and the fixes do not move.
TEST(RigidMotions, HaveNoEnergy) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  Model<3> model;
  model.fixes = {hold<3>("bottom", {2})};
  const auto problem = discretize<3, 3>(mesh, model).problem;
  const Nodes nodes(mesh);
  const RigidMotions<3, 3> motions(nodes);
  const Eigen::MatrixXd free = motions.free(problem);
  ASSERT_EQ(free.cols(), 3);
  for (Eigen::Index j = 0; j < 3; ++j) {
    Eigen::VectorXd z(3 * mesh.vertices());
    for (Index p = 0; p < mesh.vertices(); ++p)
      for (int k = 0; k < 3; ++k) z[3 * p + k] = motions.along(problem, p, k) * free.col(j);
    double energy = 0, diagonal = 0;
    for (Index p = 0; p < problem.A.size(); ++p)
      for (Offset e = problem.A.row[p]; e < problem.A.row[p + 1]; ++e)
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k) {
            const double term = z[3 * p + i] * problem.A.at(e)[3 * i + k] * z[3 * problem.A.column[e] + k];
            energy += term;
            diagonal += std::abs(term);
          }
    EXPECT_LE(std::abs(energy), 1e-13 * diagonal);
  }
}

TEST(RigidMotions, OfAScalarBodyIsTheConstant) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  Model<1> model;
  const Nodes nodes(mesh);
  const RigidMotions<2, 1> motions(nodes);
  const auto free = motions.free(discretize<2, 1>(mesh, model).problem);
  ASSERT_EQ(free.cols(), 1);
  EXPECT_EQ(motions.describe(motions.simple_basis(free)[0]), "the constant");
  model.fixes.push_back({{"top", {}, "fix"}, {0.0}});
  EXPECT_EQ((motions.free(discretize<2, 1>(mesh, model).problem).cols()), 0);
}

/// Displacements W x + stretch of some nodes, those of others are zero.
template <int D>
std::vector<double> turning(const Mesh<D>& mesh, const Eigen::Matrix<double, D, D>& G) {
  std::vector<double> u;
  for (const Point<D>& x : mesh.points) {
    const Eigen::Matrix<double, D, 1> v = G * vector<D>(x);
    for (int i = 0; i < D; ++i) u.push_back(7 + v[i]);  // a translation turns nothing
  }
  return u;
}

/// An infinitesimal rotation by that angle about no special axis.
template <int D>
Eigen::Matrix<double, D, D> turn_by(double angle) {
  if constexpr (D == 2) return angle * Eigen::Matrix2d{{0, -1}, {1, 0}};
  if constexpr (D == 3) {
    const Eigen::Vector3d a = angle * Eigen::Vector3d(1, -2, 0.5).normalized();
    return Eigen::Matrix3d{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
  }
}

template <int D>
void expect_turn() {
  Mesh<D> mesh = distorted_mesh<D>(2);
  for (Point<D>& x : mesh.points) x[0] += 1e4;  // far from zero
  const Nodes<D> nodes(mesh);
  Eigen::Matrix<double, D, D> stretch = Eigen::Matrix<double, D, D>::Random();
  stretch = (stretch + stretch.transpose()).eval();
  const double angle = 0.03;
  EXPECT_NEAR((mean_turns<D>(nodes, {}, turning<D>(mesh, turn_by<D>(angle))).at(0).angle), angle, 1e-9);
  EXPECT_NEAR((mean_turns<D>(nodes, {}, turning<D>(mesh, turn_by<D>(angle) + stretch)).at(0).angle), angle, 1e-9);
  EXPECT_NEAR((mean_turns<D>(nodes, {}, turning<D>(mesh, stretch)).at(0).angle), 0, 1e-9);
}

TEST(MeanTurn, IsTheAngleWhateverElseABodyDoes) {
  expect_turn<2>();
  expect_turn<3>();
}

// A point on a circle about the mean of the vertices would stay on it; linear kinematics leads it along the tangent.
TEST(MeanTurn, LeadsPointsOffTheirCircles) {
  Mesh<2> mesh;
  mesh.points = {{2, 0}, {0, 2}, {-2, 0}, {0, -2}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  const Nodes<2> nodes(mesh);
  const double angle = 0.01;
  const MeanTurn turn = mean_turns<2>(nodes, {}, turning<2>(mesh, turn_by<2>(angle))).at(0);
  EXPECT_NEAR(turn.radius, 2, 1e-12);
  EXPECT_NEAR(turn.off_circle(), 2 * (std::sqrt(1 + angle * angle) - 1), 1e-8);
}

// Each body has its own: the second one, which is the first one elsewhere, turns the other way and by more.
TEST(MeanTurn, IsThatOfEachBody) {
  const Mesh<2> one = unit_mesh<2>(2);
  Mesh<2> both = one;
  for (const Point<2>& x : one.points) both.points.push_back({x[0] + 3, x[1] - 1});
  std::vector<Index> body(one.points.size(), 0);
  body.resize(both.points.size(), 1);
  std::vector<double> u = turning<2>(one, turn_by<2>(0.1)), more = turning<2>(one, turn_by<2>(-0.2));
  u.insert(u.end(), more.begin(), more.end());
  const auto turns = mean_turns<2>(Nodes<2>(both), body, u);
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_NEAR(turns[0].angle, 0.1, 1e-12);
  EXPECT_NEAR(turns[1].angle, 0.2, 1e-12);
}

}  // namespace
}  // namespace signorini::testing
