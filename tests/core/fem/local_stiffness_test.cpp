// Stiffness of diffusion, element by element and row by row, against dense sums.
#include "core/fem/elements/local_stiffness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "core/fem/assembly/stiffness_scalar.hpp"
#include "core/fem/elements/symmetric_rows.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// A patch's stiffness as a matrix of its vertices.
template <std::size_t N, std::size_t E>
Eigen::MatrixXd dense(const LocalStiffness<N, E>& local, const std::array<std::array<int, 2>, E>& ends) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(N, N);
  for (std::size_t a = 0; a < N; ++a) out(a, a) = local.diagonal[a];
  for (std::size_t k = 0; k < E; ++k) out(ends[k][0], ends[k][1]) = out(ends[k][1], ends[k][0]) = local.edge[k];
  return out;
}

/// A simplex of no special shape.
template <int D>
Mesh<D> single() {
  Mesh<D> mesh;
  if constexpr (D == 2)
    mesh.points = {{0.1, 0}, {1.2, 0.3}, {0.4, 0.9}};
  else
    mesh.points = {{0.1, 0, 0.2}, {1.2, 0.3, 0}, {0.4, 0.9, -0.1}, {0.3, 0.2, 1.1}};
  Simplex<D> all;
  for (int a = 0; a <= D; ++a) all[a] = a;
  mesh.elements = {all};
  return mesh;
}

// Energies of linear functions are |gradient|^2 times the weight, whatever is the order of the vertices.
template <int D>
void expect_energy() {
  const Mesh<D> mesh = single<D>();
  const Eigen::Matrix<double, D, 1> g = Eigen::Matrix<double, D, 1>::LinSpaced(0.7, -1.9);
  Simplex<D> order = mesh.elements[0];
  do {
    Eigen::VectorXd u(D + 1);
    for (int a = 0; a <= D; ++a) u[a] = 5 + g.dot(vector<D>(mesh.points[order[a]]));
    const Eigen::MatrixXd K = dense(element_stiffness<D>(linear_element(mesh, order), 2.5), simplex_edges<D>());
    EXPECT_NEAR(u.dot(K * u), 2.5 * g.squaredNorm(), 1e-12);
  } while (std::ranges::next_permutation(order).found);
}

TEST(LocalStiffness, EnergyIsThatOfTheGradient) {
  expect_energy<2>();
  expect_energy<3>();
}

TEST(LocalStiffness, RightAnglesUncoupleTheirNodesExactly) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {std::cos(0.3), std::sin(0.3)}, {-std::sin(0.3), std::cos(0.3)}};
  const auto local = element_stiffness<2>(linear_element(mesh, Simplex<2>{0, 1, 2}), 1);
  EXPECT_EQ(local.edge[2], 0);  // between the ends of the legs
  EXPECT_NE(local.edge[0], 0);
}

// The children's stiffness, made of the father's alone, is the sum of those of the children themselves.
template <int D>
void expect_children() {
  const Mesh<D> coarse = single<D>();
  Mesh<D> fine = coarse;
  for (const auto [a, b] : simplex_edges<D>()) fine.points.push_back(midpoint<D>(fine.points[a], fine.points[b]));
  constexpr std::size_t N = std::tuple_size_v<Family<D>>;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(N, N);
  for (const auto& child : RedRefinement<D>::children) {
    const LinearElement<D> element = linear_element(fine, Simplex<D>(child));
    const Eigen::MatrixXd K = dense(element_stiffness<D>(element, 3 * element.measure), simplex_edges<D>());
    for (int a = 0; a <= D; ++a)
      for (int b = 0; b <= D; ++b) sum(child[a], child[b]) += K(a, b);
  }
  const LinearElement<D> father = linear_element(coarse, coarse.elements[0]);
  const auto found = RedStiffness<D>().children_of(element_stiffness<D>(father, 3 * father.measure));
  EXPECT_LT((dense(found, child_edges<D>()) - sum).norm(), 1e-13 * sum.norm());
}

TEST(LocalStiffness, OfChildrenFollowsFromTheFathers) {
  expect_children<2>();
  expect_children<3>();
}

/// All elements added one after the other, with the vertices numbered as `number` says.
template <int D>
BlockMatrix<1> assembled(const Mesh<D>& mesh, const std::vector<Index>& number) {
  const auto size = static_cast<Index>(mesh.elements.size());
  SymmetricRows rows(mesh.vertices(), 0);
  const auto numbered = [&](Index e) {
    std::array<Index, D + 1> out;
    std::ranges::transform(mesh.elements[e], out.begin(), [&](Index v) { return number[v]; });
    return out;
  };
  for (Index e = 0; e < size; ++e)
    for (const Index p : numbered(e)) rows.announce(e, p);
  for (Index e = 0; e < size; ++e) {
    const LinearElement<D> element = linear_element(mesh, mesh.elements[e]);
    rows.add(e, numbered(e), simplex_edges<D>(), element_stiffness<D>(element, element.measure));
  }
  return rows.take();
}

template <int D>
void expect_rows(const std::vector<Index>& number, const Mesh<D>& mesh) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(mesh.vertices(), mesh.vertices());
  for (const Simplex<D>& element : mesh.elements) {
    const LinearElement<D> flat = linear_element(mesh, element);
    for (int a = 0; a <= D; ++a)
      for (int b = 0; b <= D; ++b)
        sum(number[element[a]], number[element[b]]) += flat.measure * dot(flat.gradient[a], flat.gradient[b]);
  }
  const BlockMatrix<1> A = assembled(mesh, number);
  EXPECT_LT((testing::dense(A) - sum).norm(), 1e-13 * sum.norm());
  for (Index p = 0; p < A.size(); ++p) {
    EXPECT_EQ(A.column[A.row[p]], p);  // the diagonal first, then ascending
    EXPECT_TRUE(std::is_sorted(A.column.begin() + A.row[p] + 1, A.column.begin() + A.row[p + 1]));
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) EXPECT_GT(std::abs(*A.at(k)), 1e-14);
  }
}

/// A fan of triangles around one vertex: its row has more entries than fit into one place.
Mesh<2> fan(Index blades) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}};
  for (Index k = 0; k < blades; ++k) {
    const double angle = 2 * std::numbers::pi * k / blades;
    mesh.points.push_back({std::cos(angle), std::sin(angle)});
    mesh.elements.push_back({0, 1 + k, 1 + (k + 1) % blades});
  }
  return mesh;
}

TEST(SymmetricRows, AreTheSumOfElementsWhateverTheNumbering) {
  const auto numbers = [](Index count, bool shuffled) {
    std::vector<Index> out(count);
    std::iota(out.begin(), out.end(), 0);
    if (shuffled) std::shuffle(out.begin(), out.end(), std::mt19937(2));
    return out;
  };
  for (const bool shuffled : {false, true}) {
    const Mesh<2> flat = distorted_mesh<2>(9), wheel = fan(40);
    const Mesh<3> body = distorted_mesh<3>(4);
    expect_rows(numbers(flat.vertices(), shuffled), flat);
    expect_rows(numbers(wheel.vertices(), shuffled), wheel);
    expect_rows(numbers(body.vertices(), shuffled), body);
  }
}

// By families, with one coefficient: the same matrix as that of the elements one by one.
template <int D>
void expect_scalar_stiffness() {
  const MeshHierarchy<D> meshes = hierarchy(distorted_mesh<D>(2), 1);
  const Mesh<D>& mesh = meshes.finest();
  Model<1> model;
  model.diffusion = 2;
  std::vector<Index> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  const Eigen::MatrixXd found = testing::dense(scalar_stiffness<D>(Nodes<D>(mesh), model)),
                        wanted = 2 * testing::dense(assembled(mesh, number));
  EXPECT_LT((found - wanted).norm(), 1e-13 * wanted.norm());
}

TEST(SymmetricRows, MakeTheStiffnessOfFamilies) {
  expect_scalar_stiffness<2>();
  expect_scalar_stiffness<3>();
}

}  // namespace
}  // namespace signorini::testing
