// Matrices and interpolations in jumps against dense products.
#include "core/mortar/jump_basis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/core/mortar/surfaces.hpp"
#include "tests/support/dense.hpp"

namespace signorini::test {
namespace {

// Z with B components per vector.
Eigen::MatrixXd dense_basis(const JumpBasis& Z, int B) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(Z.vectors() * B, Z.vectors() * B);
  for (Index p = 0; p < Z.vectors(); ++p)
    for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) out(p * B + i, Z.column[k] * B + i) += Z.weight[k];
  return out;
}

Eigen::MatrixXd dense_weights(const Prolongation& P, int B) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(P.fine() * B, P.coarse * B);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) out(p * B + i, P.column[k] * B + i) += P.weight[k];
  return out;
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
  JumpBasis Z;

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
    Z = jump_basis<D>(static_cast<Index>(all.points.size()), {&coupling, 1}, "contact");
  }
};

template <int N>
using Number = std::integral_constant<int, N>;
template <class N>
class Jumps : public testing::Test {};
using Dimensions = testing::Types<Number<2>, Number<3>>;
TYPED_TEST_SUITE(Jumps, Dimensions);

TYPED_TEST(Jumps, ThereAndBackIsTheIdentity) {
  constexpr int D = TypeParam::value;
  const TwoBodies<D> bodies(3, 0.05);
  Random random(2);
  const Eigen::MatrixXd Z = dense_basis(bodies.Z, D);
  std::vector<double> x(bodies.all.points.size() * D);
  for (double& c : x) c = random.between(-1, 1);
  const Eigen::VectorXd before = vector(x);
  from_jumps<D>(bodies.Z, x.data());
  EXPECT_LE((vector(x) - Z * before).norm(), 1e-13);
  to_jumps<D>(bodies.Z, x.data());
  EXPECT_LE((vector(x) - before).norm(), 1e-13);
  forces_to_jumps<D>(bodies.Z, x.data());
  EXPECT_LE((vector(x) - Z.transpose() * before).norm(), 1e-12);
}

TYPED_TEST(Jumps, MatrixIsTheDenseProduct) {
  constexpr int D = TypeParam::value;
  const TwoBodies<D> bodies(2, 0.05);
  Random random(3);
  for (const double density : {0.02, 0.3}) {
    const auto A = random_symmetric<D>(random, bodies.Z.vectors(), density);
    const auto C = matrix_of_jumps<D>(A, bodies.Z);
    const Eigen::MatrixXd Z = dense_basis(bodies.Z, D), expected = Z.transpose() * dense(A) * Z;
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

TYPED_TEST(Jumps, CoarseMatricesAreThoseOfTheInterpolatedDisplacements) {
  constexpr int D = TypeParam::value;
  for (const double slope : {0.0, 0.05}) {
    const TwoBodies<D> coarse(1, slope), fine(2, slope);
    const Prolongation P = between<D>(2, 3);
    ASSERT_EQ(P.fine(), fine.Z.vectors());
    ASSERT_EQ(P.coarse, coarse.Z.vectors());
    const Prolongation Q = prolongation_of_jumps(fine.Z, P, coarse.Z);
    const Eigen::MatrixXd Zf = dense_basis(fine.Z, D), Zc = dense_basis(coarse.Z, D), PZ = dense_weights(P, D) * Zc;
    EXPECT_LE((Zf * dense_weights(Q, D) - PZ).norm(), 1e-11 * PZ.norm());
    Random random(4);
    const auto A = random_symmetric<D>(random, fine.Z.vectors(), 0.1);
    const Eigen::MatrixXd C =
        dense_weights(Q, D).transpose() * dense(matrix_of_jumps<D>(A, fine.Z)) * dense_weights(Q, D);
    const Eigen::MatrixXd expected = PZ.transpose() * dense(A) * PZ;
    EXPECT_LE((C - expected).norm(), 1e-11 * expected.norm());
    EXPECT_EQ(Q.twins(), P.twins());
  }
}

// Where both sides have one mesh jumps interpolate as displacements do: what vanishes is left out.
TYPED_TEST(Jumps, OfMatchingMeshesInterpolateAsDisplacements) {
  constexpr int D = TypeParam::value;
  const Prolongation P = between<D>(4, 4);
  const Prolongation Q = prolongation_of_jumps(TwoBodies<D>(4, 0, true).Z, P, TwoBodies<D>(2, 0, true).Z);
  EXPECT_EQ(Q.row, P.row);
  EXPECT_EQ(Q.column, P.column);
  for (std::size_t k = 0; k < P.weight.size(); ++k) EXPECT_NEAR(Q.weight[k], P.weight[k], 1e-12);
}

TYPED_TEST(Jumps, NodesOfTwoRolesAreRefused) {
  constexpr int D = TypeParam::value;
  const TwoBodies<D> bodies(1, 0);
  const auto message = [&](const MortarCoupling<D>& other) -> std::string {
    const std::vector<MortarCoupling<D>> both{bodies.coupling, other};
    try {
      jump_basis<D>(bodies.Z.vectors(), both, "contacts");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(bodies.coupling), testing::HasSubstr("contacts: node 0 is on the slave side of two contacts"));
  MortarCoupling<D> chain = bodies.coupling;
  for (Index& p : chain.node) p = bodies.Z.vectors() - 1 - p;
  EXPECT_THAT(message(chain), testing::HasSubstr("on the master side of another"));
}

}  // namespace
}  // namespace signorini::test
