// The projection onto a polyhedral cone satisfies the conditions of a nearest point.
#include "core/base/cone_projection.hpp"

#include <gtest/gtest.h>

#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

TEST(Cone, ProjectionIsTheNearestPoint) {
  Random random(71);
  for (int trial = 0; trial < 500; ++trial) {
    const Index columns = 1 + random.below(6), rows = 1 + random.below(40);
    Eigen::MatrixXd G(rows, columns);
    Eigen::VectorXd g(columns);
    for (double& v : G.reshaped()) v = random.between(-1, trial % 3 ? 1 : 0.1);
    for (double& v : g) v = random.between(-1, 1);
    G.rowwise().normalize();
    if (trial % 5 == 0 && rows > 1) G.row(1) = G.row(0);  // a condition that stands twice
    const Eigen::VectorXd c = project_onto_cone(G, g);
    EXPECT_GE((G * c).minCoeff(), -1e-10 * g.norm());
    EXPECT_LE(std::abs(c.dot(g - c)), 1e-10 * g.squaredNorm());
    // No other point of the cone is in an acute angle with g - c.
    for (int sample = 0; sample < 200; ++sample) {
      Eigen::VectorXd other(columns);
      for (double& v : other) v = random.between(-1, 1);
      if ((G * other).minCoeff() < 0) continue;
      EXPECT_LE(other.dot(g - c), 1e-10 * g.norm());
    }
  }
}

TEST(Cone, IsAllOrNothingWhereConditionsSaySo) {
  const Eigen::Vector2d g(1, -2);
  const Eigen::MatrixXd all = Eigen::RowVector2d(0, -1);
  EXPECT_LE((project_onto_cone(all, g) - g).norm(), 1e-15);
  Eigen::MatrixXd nothing(4, 2);
  nothing << 1, 0, -1, 0, 0, 1, 0, -1;
  EXPECT_LE(project_onto_cone(nothing, g).norm(), 1e-14);
}

}  // namespace
}  // namespace signorini::test
