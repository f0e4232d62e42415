// Sizes of strains of fields whose strains are known.
#include "core/fem/recovery/strain.hpp"

#include <gtest/gtest.h>

#include "core/mesh/connected.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/refine.hpp"
#include "support.hpp"

namespace signorini::testing {
namespace {

/// Stretches along turned axes, and a small rotation, which is no strain.
template <int D>
std::vector<double> stretched(const Mesh<D>& mesh, const std::array<double, D>& by) {
  const auto Q = rotation<D>();
  Eigen::Matrix<double, D, D> A = Eigen::Matrix<double, D, D>::Zero();
  for (int k = 0; k < D; ++k) A += by[k] * Q.col(k) * Q.col(k).transpose();
  A(0, 1) += 0.7, A(1, 0) -= 0.7;
  std::vector<double> u;
  for (const Point<D>& x : mesh.points)
    for (int i = 0; i < D; ++i) u.push_back(A.row(i).dot(vector<D>(x)));
  return u;
}

template <int D>
void expect_sizes(const std::array<double, D>& by, double largest, double large, double folded) {
  const MeshHierarchy<D> meshes = hierarchy(distorted_mesh<D>(2), 1);
  const Mesh<D>& mesh = meshes.finest();
  for (const int order : {1, 2}) {
    const Nodes<D> nodes(mesh, order);
    const StrainSizes<D> found = strain_sizes(nodes, Plane::strain, {}, nodes.at_nodes(stretched<D>(mesh, by), D));
    EXPECT_NEAR(found.largest, largest, 1e-12);
    EXPECT_NEAR(found.large, large, 1e-12);
    EXPECT_NEAR(found.folded, folded, 1e-12);
  }
}

TEST(StrainSizes, AreThoseOfPrincipalStrains) {
  expect_sizes<2>({0.3, -0.2}, 0.3, 1, 0);
  expect_sizes<2>({0.3, -1.1}, -1.1, 1, 1);
  expect_sizes<3>({10, -0.9, 0.2}, 10, 1, 0);
  expect_sizes<3>({0.5, -3, -3}, -3, 1, 1);  // an even number of axes turned round: volumes are positive
  const Mesh<3> mesh = unit_mesh<3>(2);
  const auto small = strain_sizes(Nodes<3>(mesh), Plane::strain, {}, stretched<3>(mesh, {0.05, -0.02, 0.01}));
  EXPECT_EQ(small.large, 0);
  EXPECT_LT(small.largest, large_strain);
}

// A ring that is widened: hoop strain 0.5; one pressed to its axis and beyond.
TEST(StrainSizes, CountHoops) {
  const Mesh<2> mesh = rectangle({1, 0}, {1.1, 1}, {1, 4});
  for (const double by : {0.5, -1.5}) {
    std::vector<double> u;
    for (const Point<2>& x : mesh.points) u.insert(u.end(), {by * x[0], 0});
    const auto found = strain_sizes(Nodes<2>(mesh), Plane::axisymmetric, {}, u);
    EXPECT_NEAR(found.largest, by, 1e-12);
    EXPECT_EQ(found.folded, by < -1 ? 1 : 0);
  }
}

// The smaller one of two bodies is folded, or half of it.
TEST(StrainSizes, AreThoseOfTheWorstBody) {
  const Mesh<2> mesh =
      join<2>({rectangle({0, 0}, {10, 10}, {2, 2}), rectangle({0, 10}, {1, 11}, {2, 2})}, {"large", "small"}, {0, 0});
  for (const double from : {10.0, 10.5}) {
    std::vector<double> u;
    for (const Point<2>& x : mesh.points) u.insert(u.end(), {0, -1.5 * std::max(0.0, x[1] - from)});
    const auto found = strain_sizes(Nodes<2>(mesh), Plane::strain, connected_parts(mesh), u);
    EXPECT_NEAR(found.folded, from == 10 ? 1 : 0.5, 1e-12);
    EXPECT_NEAR(found.large, from == 10 ? 1 : 0.5, 1e-12);
    EXPECT_NEAR(found.largest, -1.5, 1e-12);
    EXPECT_GT(found.place[1], from);
  }
}

}  // namespace
}  // namespace signorini::testing
