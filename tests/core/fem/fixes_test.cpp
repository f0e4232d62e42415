#include "core/fem/conditions/fixes.hpp"

#include "core/fem/conditions/directions.hpp"

#include <gtest/gtest.h>

#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

template <int B>
const FixedDirections<B>* at(const std::vector<FixedDirections<B>>& fixes, Index vertex) {
  for (const auto& f : fixes)
    if (f.vertex == vertex) return &f;
  return nullptr;
}

// One fix with a normal frame over three faces of a cube that meet in the origin, turned in space.
TEST(Fixes, NormalFrameHoldsAlongEveryFaceAtEdgesAndCorners) {
  Mesh<3> mesh = unit_mesh<3>(2);
  const Index corner = vertex_at<3>(mesh, {0, 0, 0}), edge = vertex_at<3>(mesh, {0.5, 0, 0}),
              face = vertex_at<3>(mesh, {0.5, 0, 0.5});
  rotate_mesh(mesh);
  const Eigen::Matrix3d R = rotation<3>();
  Model<3> model;
  model.fixes.push_back({Selection{{},
                                   expression([R](const Site& s) {
                                     const Eigen::Vector3d n = R.transpose() * Eigen::Vector3d(s.n[0], s.n[1], s.n[2]);
                                     return n.minCoeff() < -0.9;
                                   }),
                                   ""},
                         {},
                         Frame::normal});
  model.fixes[0].value[0] = 0.5;
  const auto fixes = collect_fixes(mesh, model);
  EXPECT_EQ(at(fixes, corner)->count, 3);
  EXPECT_EQ(at(fixes, edge)->count, 2);
  ASSERT_EQ(at(fixes, face)->count, 1);
  const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3d>(at(fixes, face)->direction[0]);
  EXPECT_LT((n + R.col(1)).norm(), 1e-14);
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    u += at(fixes, corner)->value[k] * Eigen::Map<const Eigen::Vector3d>(at(fixes, corner)->direction[k]);
  EXPECT_LT((u - R * Eigen::Vector3d(-0.5, -0.5, -0.5)).norm(), 1e-14);
}

// A coarse polygon whose sides meet at 45 degrees: one normal if it approximates a circle, two otherwise.
TEST(Fixes, CurvedPartsHaveOneAveragedNormal) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}};
  for (int k = 0; k < 8; ++k) {
    mesh.points.push_back({std::cos(k * M_PI / 4), std::sin(k * M_PI / 4)});
    mesh.elements.push_back({0, 1 + k, 1 + (k + 1) % 8});
    mesh.boundary.push_back({{1 + k, 1 + (k + 1) % 8}, k, 0});
  }
  mesh.curves = {{{0, 0}, 1}};
  Model<2> model;
  model.fixes.push_back(fix<2>({}, {0.25, std::nullopt}, Frame::normal));
  for (const auto& f : collect_fixes(mesh, model)) {
    ASSERT_EQ(f.count, 1);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(f.direction[0][i], mesh.points[f.vertex][i], 1e-14);
    EXPECT_EQ(f.value[0], 0.25);
  }
  for (auto& face : mesh.boundary) face.curve = -1;
  for (const auto& f : collect_fixes(mesh, model)) EXPECT_EQ(f.count, 2);
}

TEST(Fixes, LaterConditionHoldsInTheSameDirection) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<2> model;
  model.fixes = {fix<2>("left", {1.0, 2.0}), fix<2>("bottom", {std::nullopt, 3.0})};
  const auto fixes = collect_fixes(mesh, model);
  const FixedDirections<2>* corner = at(fixes, vertex_at<2>(mesh, {0, 0}));
  ASSERT_EQ(corner->count, 2);
  double u[2] = {};
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 2; ++i) u[i] += corner->value[k] * corner->direction[k][i];
  EXPECT_EQ(u[0], 1);
  EXPECT_EQ(u[1], 3);
}

TEST(Fixes, ObliqueDirectionsAreSolvedFor) {
  FixedDirections<3> fixed;
  const Eigen::Vector3d u(0.3, -0.7, 0.2), a = Eigen::Vector3d(1, 2, 0).normalized(),
                                           b = Eigen::Vector3d(1, 1, 1).normalized();
  fixed.add(a.data(), a.dot(u), 2);
  fixed.add(b.data(), b.dot(u), 1);
  const auto found = fixed.add(a.data(), 17, 0);  // already prescribed
  EXPECT_EQ(found.fix, 2);
  EXPECT_NEAR(found.by, std::abs(17 - a.dot(u)), 1e-12);
  ASSERT_EQ(fixed.count, 2);
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  for (int k = 0; k < 2; ++k) v += fixed.value[k] * Eigen::Map<const Eigen::Vector3d>(fixed.direction[k]);
  EXPECT_NEAR(a.dot(v), a.dot(u), 1e-15);
  EXPECT_NEAR(b.dot(v), b.dot(u), 1e-15);
}

TEST(Fixes, TangentsCompleteAnOrthonormalBasis) {
  for (const Point<3>& n :
       {Point<3>{1, 0, 0}, Point<3>{0, -1, 0}, Point<3>{0.6, 0, 0.8}, Point<3>{1.0 / 3, 2.0 / 3, -2.0 / 3}}) {
    const auto t = tangents(n);
    Eigen::Matrix3d Q;
    Q << vector<3>(n), vector<3>(t[0]), vector<3>(t[1]);
    EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), 1e-15);
    EXPECT_NEAR(Q.determinant(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace signorini::testing
