#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "core/base/dense.hpp"
#include "core/base/error.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/element_points.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::HasSubstr;

template <int D>
Mesh<D> reference_element() {
  Mesh<D> mesh;
  mesh.points.resize(D + 1);
  for (int i = 0; i < D; ++i) mesh.points[i + 1][i] = 1;
  for (int i = 0; i <= D; ++i) mesh.elements.resize(1), mesh.elements[0][i] = i;
  return mesh;
}

// The thermal load is what the element's stiffness makes of a displacement that expands it.
template <int D>
void expect_free_expansion() {
  const Mesh<D> mesh = reference_element<D>();
  const Nodes<D> nodes(mesh);
  Model<D> model;
  model.temperature = 3;
  model.expansion = 0.1;
  ElementPoints<D, 1> points(nodes, model);
  points.move_to(0, true);
  constexpr std::size_t count = D + 1;
  for (std::size_t a = 0; a < count; ++a) {
    Point<D> left{};
    double load[D] = {};
    points.add_thermal_load(a, load);
    for (std::size_t b = 0; b < count; ++b) {
      double entry[D * D] = {};
      points.add_block(a, b, entry);
      const auto place = node_place<D>(b);  // barycentric coordinates: the first one belongs to the origin
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) left[i] += entry[i * D + j] * 0.3 * place[static_cast<std::size_t>(j) + 1];
    }
    for (int i = 0; i < D; ++i) EXPECT_NEAR(left[i], load[i], 1e-14);
  }
}

TEST(ElementPoints, WhatIsFreeToExpandHasNoStress) {
  expect_free_expansion<2>();
  expect_free_expansion<3>();
}

TEST(Stiffness, DiffusionOnTheReferenceTriangle) {
  Model<1> model;
  model.diffusion = 2;
  Eigen::Matrix3d expected;
  expected << 2, -1, -1, -1, 1, 0, -1, 0, 1;
  EXPECT_LT((dense(stiffness(reference_element<2>(), model)) - expected).norm(), 1e-15);
}

TEST(Stiffness, DiffusionOnTheReferenceTetrahedron) {
  Eigen::Matrix4d expected;
  expected << 3, -1, -1, -1, -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  EXPECT_LT((dense(stiffness(reference_element<3>(), Model<1>{})) - expected / 6).norm(), 1e-15);
}

// B' C B area with the strain matrix B of the reference triangle and Hooke's matrix C.
Eigen::MatrixXd triangle_elasticity(const Eigen::Matrix3d& C) {
  Eigen::Matrix<double, 3, 6> strain;
  strain << -1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, -1, -1, 0, 1, 1, 0;
  return 0.5 * strain.transpose() * C * strain;
}

TEST(Stiffness, ElasticityOnTheReferenceTriangle) {
  const double E = 3, nu = 0.3;
  Model<2> model;
  model.young = E;
  model.poisson = nu;
  Eigen::Matrix3d C;
  C << 1 - nu, nu, 0, nu, 1 - nu, 0, 0, 0, (1 - 2 * nu) / 2;
  EXPECT_LT(
      (dense(stiffness(reference_element<2>(), model)) - triangle_elasticity(E / ((1 + nu) * (1 - 2 * nu)) * C)).norm(),
      1e-14);
  model.plane = Plane::stress;
  C << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  EXPECT_LT((dense(stiffness(reference_element<2>(), model)) - triangle_elasticity(E / (1 - nu * nu) * C)).norm(),
            1e-14);
}

template <int D, int B>
void expect_layout_and_symmetry() {
  Model<B> model;
  model.poisson = 0.3;
  const BlockMatrix<B> A = stiffness(distorted_mesh<D>(4), model);
  ASSERT_EQ(A.row.back(), static_cast<Offset>(A.column.size()));
  ASSERT_EQ(A.value.size(), A.column.size() * B * B);
  for (Index p = 0; p < A.size(); ++p) {
    EXPECT_EQ(A.column[A.row[p]], p);
    EXPECT_TRUE(std::is_sorted(A.column.begin() + A.row[p] + 1, A.column.begin() + A.row[p + 1]));
  }
  const Eigen::MatrixXd M = dense(A);
  EXPECT_EQ((M - M.transpose()).norm(), 0);
}

// Numbers far apart, elements in any order: rows wait long for their last element.
template <int D, int B>
void expect_independence_of_numbers() {
  const Mesh<D> mesh = distorted_mesh<D>(4);
  std::vector<Index> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 random(1);
  std::shuffle(number.begin(), number.end(), random);
  Mesh<D> shuffled = mesh;
  std::shuffle(shuffled.elements.begin(), shuffled.elements.end(), random);
  for (std::size_t p = 0; p < number.size(); ++p) shuffled.points[number[p]] = mesh.points[p];
  for (auto& element : shuffled.elements)
    for (Index& p : element) p = number[p];
  const Eigen::MatrixXd A = dense(stiffness(mesh, Model<B>{})), other = dense(stiffness(shuffled, Model<B>{}));
  for (Index p = 0; p < mesh.vertices(); ++p)
    for (Index q = 0; q < mesh.vertices(); ++q)
      EXPECT_LT((A.block<B, B>(p * B, q * B) - other.block<B, B>(number[p] * B, number[q] * B)).norm(),
                1e-14 * A.norm());
}

TEST(Stiffness, DoesNotDependOnTheNumbersOfVerticesAndElements) {
  expect_independence_of_numbers<2, 1>();
  expect_independence_of_numbers<3, 1>();
  expect_independence_of_numbers<3, 3>();
}

TEST(Stiffness, RowsStartWithTheDiagonalAndTheMatrixIsSymmetric) {
  expect_layout_and_symmetry<2, 1>();
  expect_layout_and_symmetry<3, 1>();
  expect_layout_and_symmetry<2, 2>();
  expect_layout_and_symmetry<3, 3>();
}

template <int D>
void expect_kernel_is_rigid() {
  Model<D> model;
  model.young = 10;
  model.poisson = 0.4;
  Mesh<D> mesh = distorted_mesh<D>(2);
  rotate_mesh(mesh);
  const Eigen::VectorXd values = eigenpairs(dense(stiffness(mesh, model))).values;
  const int modes = D * (D + 1) / 2;
  EXPECT_LT(values.head(modes).cwiseAbs().maxCoeff(), 1e-13 * values.maxCoeff());
  EXPECT_GT(values[modes], 1e-4 * values.maxCoeff());
}

TEST(Stiffness, KernelConsistsOfTheRigidMotions) {
  expect_kernel_is_rigid<2>();
  expect_kernel_is_rigid<3>();
}

TEST(Stiffness, ExpressionsAreTakenAtTheCentroids) {
  Model<1> model;
  model.diffusion = expression([](const Site& s) { return 1 + 3 * s.x[0] + s.x[1] * s.t; });
  model.t = 6;
  const Eigen::Matrix3d A = dense(stiffness(reference_element<2>(), model));
  EXPECT_NEAR(A(0, 0), 1 + 1 + 2, 1e-14);
}

template <int D, int B>
std::string message(const Mesh<D>& mesh, const Model<B>& model) {
  try {
    stiffness(mesh, model);
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Exit::input);
    return e.what();
  }
  return "no error";
}

// A refined mesh against itself without families, that is, element by element.
template <int D>
void expect_same_by_families(const Mesh<D>& mesh, const Model<1>& model = {}) {
  ASSERT_EQ(mesh.families.size() << D, mesh.elements.size());
  Mesh<D> strangers = mesh;
  strangers.families.clear();
  const BlockMatrix<1> A = stiffness(mesh, model), other = stiffness(strangers, model);
  EXPECT_EQ(A.row, other.row);
  ASSERT_EQ(A.column, other.column);
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      EXPECT_NEAR(A.value[k], other.value[k], 2e-14 * std::sqrt(*A.diagonal(p) * *A.diagonal(A.column[k])));
  EXPECT_EQ((dense(A) - dense(A).transpose()).norm(), 0);
}

template <int D>
Mesh<D> refined(Mesh<D> mesh, int times = 1) {
  return hierarchy(std::move(mesh), times).finest();
}

template <int D>
void expect_same_by_families() {
  expect_same_by_families(refined(unit_mesh<D>(3), 2));  // right angles, of lengths that are no binary fractions
  expect_same_by_families(refined(distorted_mesh<D>(4)));
  Mesh<D> rotated = unit_mesh<D>(3);
  rotate_mesh(rotated);
  expect_same_by_families(refined(rotated));
  Model<1> varying;
  varying.diffusion = expression([](const Site& s) { return 1 + s.x[0] * s.x[1]; });
  expect_same_by_families(refined(distorted_mesh<D>(3)), varying);
}

TEST(Stiffness, OfAFamilyIsThatOfItsElements) {
  expect_same_by_families<2>();
  expect_same_by_families<3>();
}

TEST(Stiffness, OfAFamilyWithBentEdgesIsThatOfItsElements) {
  Mesh<2> plane = refined(unit_mesh<2>(3));
  Mesh<3> space = refined(unit_mesh<3>(3));
  for (std::size_t p = 0; p < plane.points.size(); p += 3) plane.points[p][1] += 0.02;
  for (std::size_t p = 0; p < space.points.size(); p += 5) space.points[p][2] += 0.02;
  expect_same_by_families(plane);
  expect_same_by_families(space);
}

TEST(Stiffness, RejectsCoefficientsOutOfRange) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<1> scalar;
  scalar.diffusion = expression([](const Site& s) { return s.x[0] - 0.5; }, "x - 0.5");
  EXPECT_THAT(message(mesh, scalar), ::testing::AllOf(HasSubstr("scene.toml:1"), HasSubstr("x - 0.5"),
                                                      HasSubstr("(0.3333"), HasSubstr("positive")));
  Model<2> elastic;
  for (const double nu : {0.5, 0.7, -1.0}) {
    elastic.poisson = nu;
    EXPECT_THAT(message(mesh, elastic), HasSubstr("poisson"));
  }
  elastic.poisson = 0.3;
  for (const double E : {0.0, -1.0}) {
    elastic.young = E;
    EXPECT_THAT(message(mesh, elastic), HasSubstr("young"));
  }
}

TEST(Stiffness, RejectsInvertedElements) {
  Mesh<3> mesh = reference_element<3>();
  std::swap(mesh.elements[0][0], mesh.elements[0][1]);
  EXPECT_THAT(message(mesh, Model<1>{}), HasSubstr("volume"));
}

TEST(Stiffness, RejectsInvertedElementsOfFamilies) {
  Mesh<3> mirrored = refined(reference_element<3>());
  for (Point<3>& x : mirrored.points) x[0] = -x[0];
  EXPECT_THAT(message(mirrored, Model<1>{}), HasSubstr("volume"));
  Mesh<2> bent = refined(reference_element<2>());
  bent.points[vertex_at(bent, {0.5, 0.5})] = {-1, -1};
  EXPECT_THAT(message(bent, Model<1>{}), HasSubstr("area"));
}

}  // namespace
}  // namespace signorini::testing
