// Matrices and interpolations in jumps against dense products.
#include "core/solver/jumps.hpp"

#include <gtest/gtest.h>

#include "core/mortar/couple.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/jump_builder.hpp"
#include "tests/core/mortar/surfaces.hpp"
#include "tests/support/dense.hpp"

namespace signorini::test {
namespace {

template <int B>
Eigen::MatrixXd dense_basis(const Jumps<B>& jumps, Index vectors) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(vectors * B, vectors * B);
  for (Index s = 0; s < jumps.size(); ++s) {
    out.middleRows<B>(jumps.vector[s] * B).setZero();
    for (Offset k = jumps.basis.row[s]; k < jumps.basis.row[s + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j)
          out(jumps.vector[s] * B + i, jumps.basis.column[k] * B + j) += jumps.basis.at(k)[i * B + j];
  }
  return out;
}

Eigen::MatrixXd dense_weights(const Prolongation& P, int B) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(P.fine() * B, P.coarse * B);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j)
          out(p * B + i, P.column[k] * B + j) +=
              P.block.empty() ? (i == j) * P.weight[k] : P.block[static_cast<std::size_t>(k) * B * B + i * B + j];
  return out;
}

/// Along the normals; `mixed`: at every third node in all directions.
template <int D>
Jumps<D> jumps_of(const MortarCoupling<D>& coupling, bool mixed) {
  JumpBuilder<D> out;
  for (Index s = 0; s < coupling.nodes(); ++s) {
    BlockRow<D> row;
    for (Offset k = coupling.row[s]; k < coupling.row[s + 1]; ++k) {
      auto& W = row[coupling.column[k]];
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          W[i * D + j] = coupling.value[k] *
                         (mixed && s % 3 == 0 ? (i == j ? 1.0 : 0.0) : coupling.normal[s][i] * coupling.normal[s][j]);
    }
    out.add(coupling.node[s], std::move(row));
  }
  return out.take();
}

/// Symmetric, coupled at random.
template <int B>
BlockMatrix<B> random_symmetric(Random& random, Index n, double density) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n * B, n * B);
  std::vector<std::vector<Index>> columns(n);
  for (Index p = 0; p < n; ++p)
    for (Index q = 0; q <= p; ++q) {
      if (p != q && !random.chance(density)) continue;
      columns[p].push_back(q);
      if (p != q) columns[q].push_back(p);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) A(p * B + i, q * B + j) = A(q * B + j, p * B + i) = random.between(-1, 1);
    }
  BlockMatrix<B> out;
  for (Index p = 0; p < n; ++p) {
    std::erase(columns[p], p);
    std::ranges::sort(columns[p]);
    columns[p].insert(columns[p].begin(), p);
    for (const Index q : columns[p]) {
      out.column.push_back(q);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) out.value.push_back(A(p * B + i, q * B + j));
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

/// Two bodies' surfaces in one numbering, refined: a wavy slave above a wavy master.
template <int D>
struct TwoBodies {
  Surface<D> all;
  std::size_t slave_faces = 0;
  MortarCoupling<D> coupling;
  Jumps<D> Z;
  Index vectors = 0;

  /// @param matching the same mesh on both sides
  TwoBodies(int cells, double slope, bool matching = false) {
    Random random(1);
    const auto plane = [=](double at) {
      return [=](const Plane<D - 1>& y) { return at + slope * std::sin(3 * y[0]); };
    };
    all = graph<D>(grid<D - 1>(0, 1, 2 * cells), random, plane(0.01));
    all.flip();
    slave_faces = all.faces.size();
    const auto on_master = matching ? grid<D - 1>(0, 1, 2 * cells) : grid<D - 1>(-0.15, 0.85, 3 * cells);
    all.add(graph<D>(on_master, random, plane(0)));
    const std::span<const std::array<Index, D>> faces(all.faces);
    coupling =
        couple<D>({all.points, faces.first(slave_faces), "slave"}, {all.points, faces.subspan(slave_faces)}, within(1));
    Z = jumps_of(coupling, slope != 0);
    vectors = static_cast<Index>(all.points.size());
  }
};

template <class N>
class JumpsOf : public testing::Test {};
TYPED_TEST_SUITE(JumpsOf, Dimensions);

TYPED_TEST(JumpsOf, ThereAndBackIsTheIdentity) {
  constexpr int D = TypeParam::value;
  const TwoBodies<D> bodies(3, 0.05);
  Random random(2);
  const Eigen::MatrixXd Z = dense_basis(bodies.Z, bodies.vectors);
  std::vector<double> x(bodies.all.points.size() * D);
  for (double& c : x) c = random.between(-1, 1);
  const Eigen::VectorXd before = vector(x);
  to_displacements(bodies.Z, x);
  EXPECT_LE((vector(x) - Z * before).norm(), 1e-13);
  to_jumps(bodies.Z, x);
  EXPECT_LE((vector(x) - before).norm(), 1e-13);
  transform_forces(bodies.Z, x);
  EXPECT_LE((vector(x) - Z.transpose() * before).norm(), 1e-12);
}

TYPED_TEST(JumpsOf, MatrixIsTheDenseProduct) {
  constexpr int D = TypeParam::value;
  const TwoBodies<D> bodies(2, 0.05);
  Random random(3);
  for (const double density : {0.02, 0.3}) {
    const auto A = random_symmetric<D>(random, bodies.vectors, density);
    auto C = A;
    reserve_couplings(bodies.Z, C);
    const double* const place = C.value.data();
    transform(bodies.Z, C);
    EXPECT_EQ(C.value.data(), place);
    const Eigen::MatrixXd Z = dense_basis(bodies.Z, bodies.vectors), expected = Z.transpose() * dense(A) * Z;
    EXPECT_LE((dense(C) - expected).norm(), 1e-13 * expected.norm());
    for (Index p = 0; p < C.size(); ++p) {
      EXPECT_EQ(C.column[C.row[p]], p);
      EXPECT_TRUE(std::is_sorted(C.column.begin() + C.row[p] + 1, C.column.begin() + C.row[p + 1]));
    }
  }
}

/// From the coarse points of both bodies to those of meshes twice as fine.
template <int D>
Prolongation between(int slave_cells, int master_cells) {
  Prolongation P;
  const auto body = [&P](Index cells) {
    const Index first = P.coarse, n = cells + 1;
    const auto add = [&](Index i, Index j) {  // the mean of two corners of a coarse cell
      P.column.push_back(first + std::min(i, j));
      P.weight.push_back(i == j ? 1 : 0.5);
      if (i != j) {
        P.column.push_back(first + std::max(i, j));
        P.weight.push_back(0.5);
      }
      P.row.push_back(static_cast<Offset>(P.column.size()));
    };
    const Index rows = D == 2 ? 1 : 2 * cells + 1;
    for (Index j = 0; j < rows; ++j)
      for (Index i = 0; i <= 2 * cells; ++i) add(j / 2 * n + i / 2, (j + 1) / 2 * n + (i + 1) / 2);
    P.coarse += D == 2 ? n : n * n;
  };
  body(slave_cells);
  body(master_cells);
  return P;
}

TYPED_TEST(JumpsOf, CoarseMatricesAreThoseOfTheInterpolatedDisplacements) {
  constexpr int D = TypeParam::value;
  for (const double slope : {0.0, 0.05}) {
    const TwoBodies<D> coarse(1, slope), fine(2, slope);
    const Prolongation P = between<D>(2, 3);
    ASSERT_EQ(P.fine(), fine.vectors);
    ASSERT_EQ(P.coarse, coarse.vectors);
    const Prolongation Q = between_jumps(P, fine.Z, coarse.Z);
    const Eigen::MatrixXd Zf = dense_basis(fine.Z, fine.vectors), Zc = dense_basis(coarse.Z, coarse.vectors),
                          PZ = dense_weights(P, D) * Zc;
    EXPECT_LE((Zf * dense_weights(Q, D) - PZ).norm(), 1e-11 * PZ.norm());
    Random random(4);
    const auto A = random_symmetric<D>(random, fine.vectors, 0.1);
    auto of_jumps = A;
    transform(fine.Z, of_jumps);
    const Eigen::MatrixXd C = dense_weights(Q, D).transpose() * dense(of_jumps) * dense_weights(Q, D);
    const Eigen::MatrixXd expected = PZ.transpose() * dense(A) * PZ;
    EXPECT_LE((C - expected).norm(), 1e-11 * expected.norm());
    EXPECT_EQ(Q.twins(), P.twins());
  }
}

// Where both sides have one mesh jumps interpolate as displacements do: what vanishes is left out.
TYPED_TEST(JumpsOf, MatchingMeshesInterpolateAsDisplacements) {
  constexpr int D = TypeParam::value;
  const Prolongation P = between<D>(4, 4);
  const Prolongation Q = between_jumps(P, TwoBodies<D>(4, 0, true).Z, TwoBodies<D>(2, 0, true).Z);
  EXPECT_EQ(Q.row, P.row);
  EXPECT_EQ(Q.column, P.column);
  EXPECT_LE((dense_weights(Q, D) - dense_weights(P, D)).norm(), 1e-12);
}

/// Rows of the inverse, as a matrix.
Eigen::MatrixXd dense_inverse(const Jumps<2>& jumps, Index vectors) {
  return dense_basis(Jumps<2>{jumps.vector, jumps.inverse, jumps.basis, jumps.given}, vectors);
}

BlockRow<2> random_row(Random& random, std::initializer_list<Index> columns) {
  BlockRow<2> out;
  for (const Index q : columns)
    for (double& w : out[q]) w = random.between(-1, 1);
  return out;
}

// Slaves that are masters of others, and a pair of vectors whose unknowns are something else altogether.
TEST(JumpBuilder, PutsRowsIntoEachOther) {
  Random random(5);
  constexpr Index vectors = 8;
  JumpBuilder<2> builder;
  const BlockRow<2> of_0 = random_row(random, {1, 4}), of_1 = random_row(random, {3, 5}),
                    of_2 = random_row(random, {0, 6});
  builder.add(0, of_0);
  builder.add(1, of_1);
  builder.add(2, of_2);
  Eigen::Matrix4d both;
  for (double& c : both.reshaped()) c = random.between(-1, 1);
  const Eigen::Matrix4d back = both.inverse();
  const auto row = [](const Eigen::Matrix4d& of, int k) {
    BlockRow<2> out;
    for (const int m : {0, 1})
      for (int i = 0; i < 4; ++i) out[3 + m][i] = of(2 * k + i / 2, 2 * m + i % 2);
    return out;
  };
  for (const int k : {0, 1}) builder.add(3 + k, row(both, k), row(back, k));
  EXPECT_TRUE(builder.leads_to(of_2, 1));
  EXPECT_TRUE(builder.leads_to({{7, {}}, {2, {}}}, 0));
  EXPECT_FALSE(builder.leads_to(of_1, 2));
  const Jumps<2> jumps = builder.take();
  const Eigen::MatrixXd Z = dense_basis(jumps, vectors), inverse = dense_inverse(jumps, vectors);
  EXPECT_LE((Z * inverse - Eigen::MatrixXd::Identity(2 * vectors, 2 * vectors)).norm(), 1e-12);
  EXPECT_LE(
      (inverse.block<2, 2>(0, 2) + Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(of_0.at(1).data()))
          .norm(),
      1e-15);
  const auto A = random_symmetric<2>(random, vectors, 0.3);
  auto C = A;
  reserve_couplings(jumps, C);
  transform(jumps, C);
  EXPECT_LE((dense(C) - Z.transpose() * dense(A) * Z).norm(), 1e-12 * dense(C).norm());
  std::vector<double> b(2 * vectors);
  for (double& c : b) c = random.between(-1, 1);
  const Eigen::VectorXd before = vector(b);
  transform_forces(jumps, b);
  EXPECT_LE((vector(b) - Z.transpose() * before).norm(), 1e-13);
  transform_forces_back(jumps, b);
  EXPECT_LE((vector(b) - before).norm(), 1e-12);
  VectorRow<2> c{{2, {1, -2}}, {5, {3, 1}}};
  Eigen::RowVectorXd coefficients = Eigen::RowVectorXd::Zero(2 * vectors), transformed = coefficients;
  for (const auto& [p, value] : c)
    for (int i = 0; i < 2; ++i) coefficients[2 * p + i] = value[i];
  transform_row<2>(jumps, c);
  for (const auto& [p, value] : c)
    for (int i = 0; i < 2; ++i) transformed[2 * p + i] = value[i];
  EXPECT_LE((transformed - coefficients * Z).norm(), 1e-13);
}

// Three that depend on each other in a circle, and one that depends on them.
TEST(JumpBuilder, ResolvesCircles) {
  Random random(7);
  constexpr Index vectors = 7;
  std::map<Index, BlockRow<2>> rows{
      {0, random_row(random, {1, 5})}, {1, random_row(random, {2, 6})}, {2, random_row(random, {0, 4})}};
  for (auto& [p, row] : rows)
    for (auto& [q, W] : row)
      for (double& w : W) w *= 0.4;
  JumpBuilder<2> builder;
  builder.add(3, random_row(random, {1, 4}));
  EXPECT_TRUE(builder.circles(rows).empty());
  for (const auto& [p, row] : rows) builder.add(p, row);
  const Jumps<2> jumps = builder.take();
  const Eigen::MatrixXd Z = dense_basis(jumps, vectors), inverse = dense_inverse(jumps, vectors);
  EXPECT_LE((Z * inverse - Eigen::MatrixXd::Identity(2 * vectors, 2 * vectors)).norm(), 1e-12);
  EXPECT_GT(Z.block(0, 2, 2, 2).norm(), 0.01);
  EXPECT_GT((Z.block(0, 0, 2, 2) - Eigen::Matrix2d::Identity()).norm(), 1e-4) << "it comes back";
}

// Around a point the sum of all jumps is nothing, unless each is of another component than the next one.
TEST(JumpBuilder, FindsCirclesThatLeaveNoUnknowns) {
  const BlockRow<2>::mapped_type all{1, 0, 0, 1}, first{1, 0, 0, 0}, second{0, 0, 0, 1};
  for (const bool turns : {false, true}) {
    JumpBuilder<2> builder;
    builder.add(0, {{1, turns ? first : all}});
    builder.add(1, {{2, turns ? second : all}});
    builder.add(2, {{3, turns ? first : all}});
    const std::map<Index, BlockRow<2>> last{{3, {{0, turns ? second : all}}}, {4, {{3, all}}}};
    EXPECT_EQ(builder.circles(last), turns ? std::vector<Index>{} : std::vector<Index>{3});
    EXPECT_TRUE(builder.leads_to(last.at(3), 3));
    EXPECT_FALSE(builder.leads_to(last.at(4), 4));
  }
}

// Of what is not chosen the unknowns are displacements, also where others refer to it.
TEST(JumpBuilder, ChoosesSome) {
  Random random(6);
  JumpBuilder<2> all, some;
  const BlockRow<2> of_0 = random_row(random, {1, 4}), of_1 = random_row(random, {3, 5});
  all.add(0, of_0);
  all.add(1, of_1);
  some.add(0, of_0);
  EXPECT_EQ(chosen_jumps(all.take(), {1, 0}), some.take());
}

/// Vectors 0 and 1 see a master each, and have the unknown of the carrier in common along (0.6, 0.8).
Jumps<2> with_common(Index carrier, const BlockRow<2>& of_carrier, const BlockRow<2>& of_other) {
  const std::array<double, 4> along{0.36, 0.48, 0.48, 0.64};
  BlockRow<2> row = of_other;
  row[carrier] = along;
  for (const auto& [q, W] : of_carrier) {
    double part[4];
    block::multiply<2>(along.data(), W.data(), part);
    for (int i = 0; i < 4; ++i) row[q][i] -= part[i];
  }
  JumpBuilder<2> builder;
  builder.add(carrier, of_carrier);
  builder.add(1 - carrier, row);
  builder.share(carrier);
  return builder.take();
}

TEST(JumpBuilder, LetsVectorsHaveAnUnknownInCommon) {
  Random random(6);
  const BlockRow<2> a = random_row(random, {2, 3}), b = random_row(random, {4, 5});
  const Jumps<2> Z = with_common(0, a, b);
  EXPECT_EQ(Z.common, std::vector<Index>{0});
  // What the carrier sees is no part of what the other one does.
  EXPECT_EQ(Z.basis.column, (std::vector<Index>{0, 2, 3, 0, 1, 4, 5}));
  EXPECT_LE((dense_basis(Z, 6) * dense_inverse(Z, 6) - Eigen::MatrixXd::Identity(12, 12)).norm(), 1e-13);
  EXPECT_EQ(chosen_jumps(Z, {1, 1}), Z);
}

// Whatever the carriers see, and though these are not the same.
TEST(JumpBuilder, InterpolatesACommonUnknownFromItself) {
  Random random(7);
  const Jumps<2> fine = with_common(0, random_row(random, {2, 3}), random_row(random, {4, 5})),
                 coarse = with_common(1, random_row(random, {2, 3}), random_row(random, {4, 5}));
  Prolongation P;
  P.coarse = 6;
  for (Index p = 0; p < 6; ++p) {
    P.column.push_back(p);
    P.weight.push_back(1);
    P.row.push_back(p + 1);
  }
  const Prolongation Q = between_jumps(P, fine, coarse);
  ASSERT_EQ(Q.row[1], 1);
  EXPECT_EQ(Q.column[0], 1);
  EXPECT_EQ(std::vector<double>(Q.block.begin(), Q.block.begin() + 4), (std::vector<double>{1, 0, 0, 1}));
  EXPECT_EQ(Q.twins()[1], 0);
  EXPECT_EQ(Q.twins()[0], -1);
  EXPECT_EQ(Q.twins()[4], 4);
}

}  // namespace
}  // namespace signorini::test
