// The motions that prescribed values leave free, counted by hand.
#include "core/fem/motions/rigid_motions.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
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

}  // namespace
}  // namespace signorini::testing
