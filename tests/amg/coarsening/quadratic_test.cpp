// Quadratic elements are recognised by their matrix: vertices, and the ends of what lies between them.
#include "amg/coarsening/quadratic.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCore>

#include "amg/black_box.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/mesh/refine.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/core/fem/support.hpp"
#include "tests/support/nightly.hpp"

namespace signorini::test {
namespace {

/// Of a moved mesh without right angles, once refined.
template <int D>
struct Refined {
  Mesh<D> fine;
  explicit Refined(Index cells) {
    Mesh<D> mesh = testing::distorted_mesh<D>(cells);
    for (Point<D>& x : mesh.points)
      for (int i = 1; i < D; ++i) x[0] += 0.2 / i * x[i];
    refine_uniformly(mesh, fine);
  }
};

template <int D, int B>
Model<B> held_below() {
  Model<B> model;
  Fix<B> fix;
  fix.on.where = testing::expression([](const Site& s) { return s.x[D - 1] < 1e-9 ? 1.0 : 0.0; });
  fix.value.fill(Field(0.0));
  model.fixes.push_back(fix);
  return model;
}

/// With values at nodes as unknowns, as most codes have them, and what is prescribed left out.
template <int D, int B>
struct ByValues {
  Eigen::SparseMatrix<double, Eigen::RowMajor> A;
  std::vector<Index> node;  ///< per vector

  ByValues(const Nodes<D>& nodes, const Model<B>& model) {
    const DiscreteProblem<B> problem = discretize<D, B>(nodes, model).problem;
    std::vector<Index> number(static_cast<std::size_t>(nodes.size()), -1);
    for (Index p = 0; p < nodes.size(); ++p)
      if (problem.fixed[p] == 0) {
        number[p] = static_cast<Index>(node.size());
        node.push_back(p);
      }
    std::vector<Eigen::Triplet<double>> entries, coefficients;
    for (const Index p : node) {
      for (Offset k = problem.A.row[p]; k < problem.A.row[p + 1]; ++k)
        for (int i = 0; i < B * B && number[problem.A.column[k]] >= 0; ++i)
          entries.emplace_back(number[p] * B + i / B, number[problem.A.column[k]] * B + i % B, problem.A.at(k)[i]);
      const auto [a, b] = nodes.ends(p);
      const auto add = [&](Index q, double weight) {
        for (int i = 0; i < B && number[q] >= 0; ++i)
          coefficients.emplace_back(number[p] * B + i, number[q] * B + i, weight);
      };
      add(p, a == b ? 1 : Nodes<D>::midpoint_coefficient(1, 0, 0));
      if (a == b) continue;
      add(a, Nodes<D>::midpoint_coefficient(0, 1, 0));
      add(b, Nodes<D>::midpoint_coefficient(0, 0, 1));
    }
    const auto size = static_cast<Eigen::Index>(node.size()) * B;
    Eigen::SparseMatrix<double, Eigen::RowMajor> T(size, size);
    A.resize(size, size);
    A.setFromTriplets(entries.begin(), entries.end());
    T.setFromTriplets(coefficients.begin(), coefficients.end());
    A = (T.transpose() * (A * T).eval()).pruned(1, 1e-14);
  }
};

template <int B>
BlockMatrix<B> blocks(const Eigen::SparseMatrix<double, Eigen::RowMajor>& A) {
  BlockMatrix<B> out;
  std::vector<double> block(static_cast<std::size_t>(A.cols()) * B);
  for (Index p = 0; p < A.rows() / B; ++p) {
    std::map<Index, std::array<double, B * B>> row;
    row[p] = {};
    for (int i = 0; i < B; ++i)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(A, p * B + i); entry; ++entry)
        row[static_cast<Index>(entry.col()) / B][i * B + entry.col() % B] = entry.value();
    const auto append = [&](Index q) {
      out.column.push_back(q);
      out.value.insert(out.value.end(), row[q].begin(), row[q].end());
    };
    append(p);
    for (const auto& [q, values] : row)
      if (q != p) append(q);
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template <int D, int B>
void expect_ends(Index cells, double most_unclear) {
  const Refined<D> mesh(cells);
  const Nodes<D> nodes(mesh.fine, 2);
  const ByValues<D, B> given(nodes, held_below<D, B>());
  const BlockMatrix<B> A = blocks<B>(given.A);
  const auto P = quadratic_interpolation<B>(A, std::vector<Flags>(given.node.size(), 0));
  ASSERT_TRUE(P.has_value()) << D << "D, " << B << " components";
  int unclear = 0;
  for (Index p = 0; p < P->fine(); ++p) {
    const auto [a, b] = nodes.ends(given.node[p]);
    const Offset first = P->row[p], count = P->row[p + 1] - first;
    const bool coarse = count == 1 && P->twin[P->column[first]] == p;
    if (a == b || coarse) {
      unclear += (a == b) != coarse;
      continue;
    }
    for (Offset k = first; k < first + count; ++k) {
      const Index end = given.node[P->twin[P->column[k]]];
      unclear += end != a && end != b;
      EXPECT_EQ(P->weight[k], 0.5);
    }
  }
  EXPECT_LE(unclear, most_unclear * P->fine());
}

TEST(QuadraticInterpolation, FindsVerticesAndEnds) {
  expect_ends<2, 1>(12, 0.02);
  expect_ends<2, 2>(12, 0.02);
  expect_ends<3, 1>(5, 0.06);  // where the boundary is free more is unclear
  expect_ends<3, 3>(5, 0.02);
}

TEST(QuadraticInterpolation, LeavesOtherMatricesAlone) {
  const auto none = []<int B>(const BlockMatrix<B>& A) {
    return !quadratic_interpolation<B>(A, std::vector<Flags>(static_cast<std::size_t>(A.size()), 0));
  };
  const Refined<2> plane(12);
  const Refined<3> space(5);
  EXPECT_TRUE(none(blocks<1>(ByValues<2, 1>(Nodes<2>(plane.fine), held_below<2, 1>()).A)));
  EXPECT_TRUE(none(blocks<2>(ByValues<2, 2>(Nodes<2>(plane.fine), held_below<2, 2>()).A)));
  EXPECT_TRUE(none(blocks<1>(ByValues<3, 1>(Nodes<3>(space.fine), held_below<3, 1>()).A)));
  EXPECT_TRUE(none(blocks<3>(ByValues<3, 3>(Nodes<3>(space.fine), held_below<3, 3>()).A)));
  EXPECT_TRUE(none(blocks<1>(laplacian(40))));
}

/// A graph in which many vectors have the neighbours of two others, and more: vectors between, but with weights of
/// their own.
TEST(QuadraticInterpolation, LeavesGraphsAlone) {
  constexpr int side = 20, corners = side * side;
  std::vector<Eigen::Triplet<double>> entries;
  int size = corners;
  const auto pull = [&](int p, int q, double weight) {
    for (const auto& [i, j, sign] : {std::tuple(p, p, 1), {q, q, 1}, {p, q, -1}, {q, p, -1}})
      entries.emplace_back(i, j, sign * weight);
  };
  for (int p = 0; p < corners; ++p)
    for (const int q : {p + 1, p + side}) {
      if (q >= corners || (q == p + 1 && q % side == 0)) continue;
      pull(p, q, 1);
      pull(p, size, 1 + size % 7);
      pull(q, size++, 1);
    }
  entries.emplace_back(0, 0, 1);
  Eigen::SparseMatrix<double, Eigen::RowMajor> A(size, size);
  A.setFromTriplets(entries.begin(), entries.end());
  EXPECT_FALSE(quadratic_interpolation<1>(blocks<1>(A), std::vector<Flags>(static_cast<std::size_t>(size), 0)));
}

template <int D, int B>
int cycles(const Nodes<D>& nodes) {
  const ByValues<D, B> given(nodes, held_below<D, B>());
  BlackBox solver(given.A, B);
  std::vector<double> b(static_cast<std::size_t>(given.A.rows()), -1.0), lower(b.size(), -infinity);
  double largest = 0;
  for (const double x : solver.solve(b).x) largest = std::max(largest, std::abs(x));
  for (std::size_t p = 0; p < given.node.size(); ++p)
    if (nodes.at(given.node[p])[D - 1] > 1 - 1e-9) lower[p * B + B - 1] = -0.3 * largest;
  const auto result = solver.solve(b, lower);
  EXPECT_TRUE(result.summary.converged());
  return result.summary.iterations;
}

/// Without it elastic bodies took 1.5 times as many, scalars in space 1.6.
TEST(QuadraticInterpolation, CyclesAreThoseOfLinearElements) {
  const Refined<2> plane(14);
  EXPECT_LE((cycles<2, 2>(Nodes<2>(plane.fine, 2))), 1.25 * (cycles<2, 2>(Nodes<2>(plane.fine))));
  const Refined<3> space(nightly(8, 6));
  EXPECT_LE((cycles<3, 1>(Nodes<3>(space.fine, 2))), 1.25 * (cycles<3, 1>(Nodes<3>(space.fine))));
  EXPECT_LE((cycles<3, 3>(Nodes<3>(space.fine, 2))), 1.25 * (cycles<3, 3>(Nodes<3>(space.fine))));
}

}  // namespace
}  // namespace signorini::test
