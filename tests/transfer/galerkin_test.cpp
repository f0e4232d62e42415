// Coarse matrices: the Galerkin product with all modifiers, local reassembly, and the stiffness of coarse meshes.
#include <gtest/gtest.h>

#include "core/base/dense.hpp"
#include "tests/support/problems.hpp"
#include "tests/transfer/two_levels.hpp"

namespace signorini::test {
namespace {

template <class Size>
class Galerkin : public testing::Test {};
using Sizes =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Galerkin, Sizes);

// P'AP, and one on the diagonal of what is off.
template <int B>
Eigen::MatrixXd galerkin(const Level<B>& fine, const Prolongation& P, const Level<B>& coarse) {
  const Eigen::MatrixXd T = interpolation(fine, P, coarse);
  Eigen::MatrixXd C = T.transpose() * dense(*fine.A) * T;
  for (Index q = 0; q < coarse.vectors; ++q)
    for (int k = 0; k < B; ++k)
      if (coarse.off[q] >> k & 1) C(q * B + k, q * B + k) = 1;
  return C;
}

TYPED_TEST(Galerkin, EqualsTheDenseProduct) {
  constexpr int B = TypeParam::value;
  Random random(21);
  for (int trial = 0; trial < 40; ++trial) {
    TwoLevels<B> t(random, 30, trial % 2 == 0, trial % 8 > 3);
    truncate(t.fine, random_flags<B>(random, 30, 0.15 * (trial % 4)));
    EXPECT_EQ(reassemble(t.transfer, t.fine, t.coarse), t.coarse.vectors);
    const Eigen::MatrixXd C = galerkin(t.fine, t.P, t.coarse);
    EXPECT_LE((dense(t.coarse.own_matrix) - C).norm(), 1e-14 * C.norm()) << trial;
    for (Index q = 0; q < t.coarse.vectors; ++q) {
      Eigen::Matrix<double, B, B> inverse;
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) inverse(i, j) = t.coarse.inverse[(q * B + i) * B + j];
      const Eigen::Matrix<double, B, B> D = C.block(q * B, q * B, B, B);
      Eigen::Matrix<double, B, B> projection = Eigen::Matrix<double, B, B>::Identity();
      for (int i = 0; i < B; ++i)
        if (t.coarse.off[q] >> i & 1) projection(i, i) = 0;
      const Eigen::VectorXd eigenvalues = eigenpairs(D).values;
      if (eigenvalues[0] > 1e-3 * eigenvalues[B - 1]) {
        EXPECT_LE((inverse * D - projection).norm(), 1e-10);
      }
    }
  }
}

/// Three levels under random phase changes.
template <int B>
struct Chain {
  const DiscreteProblem<B>& problem;
  const std::array<Prolongation, 2>& P;  // coarsest first
  std::array<Level<B>, 3> levels;
  std::array<MinMerge<B>, 2> transfer;

  Chain(const DiscreteProblem<B>& on, const std::array<Prolongation, 2>& by, bool rotate,
        std::span<const GalerkinMatrix<B>> known = {})
      : problem(on), P(by) {
    levels[2] = finest_level(problem);
    levels[2].clear_phases();
    for (int k = 1; k >= 0; --k) {
      if (!known.empty()) levels[k].galerkin = &known[k];
      transfer[k].prepare(levels[k + 1], P[k], rotate, levels[k]);
      levels[k].clear_phases();
    }
  }

  // Returns the number of rows recomputed.
  Index assemble(const std::vector<Flags>& finest, const std::vector<Flags>& middle) {
    truncate(levels[2], finest);
    Index rows = reassemble(transfer[1], levels[2], levels[1]);
    truncate(levels[1], middle);
    rows += reassemble(transfer[0], levels[1], levels[0]);
    return rows;
  }
};

template <int B>
void expect_same_matrices(const Chain<B>& a, const Chain<B>& b) {
  for (int k = 0; k < 2; ++k) {
    ASSERT_EQ(a.levels[k].off, b.levels[k].off) << "level " << k;
    ASSERT_EQ(a.levels[k].own_matrix.value, b.levels[k].own_matrix.value) << "level " << k;
    ASSERT_EQ(a.levels[k].inverse, b.levels[k].inverse) << "level " << k;
  }
}

/// A problem with frames, and the interpolations to it over two levels.
template <int B>
std::pair<DiscreteProblem<B>, std::array<Prolongation, 2>> random_hierarchy(Random& random, Index n, bool blocks) {
  auto problem = random_problem<B>(random, n, 1);
  problem.A = random_matrix<B>(random, n, 1);
  problem.frames = random_frames<B>(random, n);
  auto coarser = random_prolongation(random, n / 16, n / 4), finer = random_prolongation(random, n / 4, n);
  if (B > 1 && blocks) make_blocks<B>(random, finer);
  return {std::move(problem), {std::move(coarser), std::move(finer)}};
}

TYPED_TEST(Galerkin, ReassemblesLocallyToTheBitWhatAFullAssemblyGives) {
  constexpr int B = TypeParam::value;
  constexpr Index n = 240;
  Random random(22);
  for (const bool rotate : {true, false}) {
    const auto [problem, P] = random_hierarchy<B>(random, n, rotate);
    Chain<B> chain(problem, P, rotate);
    std::vector<Flags> finest = random_flags<B>(random, n, 0.1), middle = random_flags<B>(random, n / 4, 0.1);
    chain.assemble(finest, middle);
    Index fewest = n;
    for (int change = 0; change < 60; ++change) {
      // A few flags flip; now and then nearly everything is in contact, so that coarse vectors lose all they have.
      if (change % 20 == 10) finest = random_flags<B>(random, n, 0.9);
      if (change % 20 == 15) finest.assign(n, 0);
      for (int flips = random.below(4); flips > 0; --flips)
        finest[random.below(n)] = static_cast<Flags>(random.below(1 << B));
      if (change % 3 == 0) middle[random.below(n / 4)] = static_cast<Flags>(random.below(1 << B));
      const Index rows = chain.assemble(finest, middle);
      if (rows > 0) fewest = std::min(fewest, rows);
      Chain<B> fresh(problem, P, rotate);
      fresh.assemble(finest, middle);
      expect_same_matrices(chain, fresh);
      if (this->HasFatalFailure()) FAIL() << "change " << change << ", rotate " << rotate;
      EXPECT_EQ(chain.assemble(finest, middle), 0) << "nothing changed";
    }
    EXPECT_LT(fewest, (n / 4 + n / 16) / 3);
  }
}

// What is truncated when the matrix is made may come back later: its couplings are in the pattern all the same.
TYPED_TEST(Galerkin, InOnePassIsToTheBitThatOfPatternAndValuesOneByOne) {
  constexpr int B = TypeParam::value;
  constexpr Index n = 60;
  Random random(24);
  for (int trial = 0; trial < 24; ++trial) {
    const bool rotate = trial % 2 == 0;
    TwoLevels<B> t(random, n, rotate, trial % 8 > 3);
    truncate(t.fine, random_flags<B>(random, n, 0.3 * (trial % 4)));
    MinMerge<B> transfer;
    Level<B> coarse;
    transfer.prepare_assembled(t.fine, t.P, rotate, coarse);
    coarse.clear_phases();
    const auto expect_same = [&] {
      EXPECT_EQ(coarse.own_matrix.row, t.coarse.own_matrix.row) << trial;
      EXPECT_EQ(coarse.own_matrix.column, t.coarse.own_matrix.column) << trial;
      EXPECT_EQ(coarse.own_matrix.value, t.coarse.own_matrix.value) << trial;
      EXPECT_EQ(coarse.inverse, t.coarse.inverse) << trial;
      EXPECT_EQ(coarse.off, t.coarse.off) << trial;
    };
    Level<B> same = t.fine;
    reassemble(t.transfer, t.fine, t.coarse);
    expect_same();
    for (Level<B>* fine : {&t.fine, &same}) {
      fine->outdated.changed.clear();
      truncate(*fine, std::vector<Flags>(n, 0));
    }
    reassemble(t.transfer, t.fine, t.coarse);
    reassemble(transfer, same, coarse);
    expect_same();
  }
}

TYPED_TEST(Galerkin, TakesOverMatricesKnownWithoutTruncation) {
  constexpr int B = TypeParam::value;
  constexpr Index n = 240;
  Random random(23);
  for (const bool rotate : {true, false}) {
    const auto [problem, P] = random_hierarchy<B>(random, n, rotate);
    const std::vector<Flags> none(n, 0);
    Chain<B> untruncated(problem, P, rotate);
    const Index all = untruncated.assemble(none, none);
    std::vector<GalerkinMatrix<B>> known;
    known.reserve(2);
    for (int k = 0; k < 2; ++k) known.push_back({untruncated.levels[k].own_matrix, untruncated.levels[k].off});
    EXPECT_EQ(Chain<B>(problem, P, rotate, known).assemble(none, none), 0);
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<Flags> finest = none, middle = none;
      for (int flips = 0; flips < 3; ++flips) finest[random.below(n)] = static_cast<Flags>(random.below(1 << B));
      middle[random.below(n / 4)] = 1;
      Chain<B> fresh(problem, P, rotate), chain(problem, P, rotate, known);
      fresh.assemble(finest, middle);
      EXPECT_LT(chain.assemble(finest, middle), all / 2);
      expect_same_matrices(chain, fresh);
    }
  }
}

// The stiffness of boxes of tetrahedra is zero between vertices that truncation on a finer mesh couples. Levels below,
// computed from that stiffness without the zeros, lack their products.
TEST(GalerkinBelowNestedMeshes, HasTheCouplingsThatTruncationBrings) {
  const MeshHierarchy<3> meshes = hierarchy<3>(box({0, 0, 0}, {1, 1, 1}, {5, 5, 5}), 1);
  const auto on_mesh = [&](std::size_t k) {
    DiscreteProblem<1> problem;
    problem.A = stiffness<3, 1>(meshes.levels[k], {});
    problem.b.assign(static_cast<std::size_t>(problem.A.size()), 0);
    problem.fixed.assign(static_cast<std::size_t>(problem.A.size()), 0);
    return problem;
  };
  const DiscreteProblem<1> fine = on_mesh(1), coarse = on_mesh(0);
  Random random(26);
  const std::array<Prolongation, 2> P{random_prolongation(random, coarse.A.size() / 4, coarse.A.size()),
                                      prolongations(meshes, nodes_of(meshes))[0]};
  Level<1> above = finest_level(coarse), below;
  above.clear_phases();
  MinMerge<1>().prepare_assembled(above, P[0], true, below);
  const std::vector<GalerkinMatrix<1>> known{{below.own_matrix, below.off}, {coarse.A, coarse.fixed, false}};
  Chain<1> chain(fine, P, true, known), fresh(fine, P, true);
  ASSERT_GT(chain.levels[1].own_matrix.column.size(), coarse.A.column.size()) << "no zeros are left out";
  const std::vector<Flags> truncated = random_flags<1>(random, fine.A.size(), 0.3), none(coarse.fixed);
  chain.assemble(truncated, none);
  fresh.assemble(truncated, none);
  for (int k = 0; k < 2; ++k) {
    const Eigen::MatrixXd expected = dense(fresh.levels[k].own_matrix);
    EXPECT_LE((dense(chain.levels[k].own_matrix) - expected).norm(), 1e-13 * expected.norm()) << "level " << k;
  }
}

template <int D, int B>
void expect_coarse_stiffness(const Mesh<D>& coarsest) {
  Model<B> model;
  model.poisson = 0.3;
  const MeshHierarchy<D> meshes = hierarchy<D>(coarsest, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    DiscreteProblem<B> fine_problem;
    fine_problem.A = stiffness<D, B>(meshes.levels[k + 1], model);
    fine_problem.b.assign(static_cast<std::size_t>(fine_problem.A.size()) * B, 0);
    fine_problem.fixed.assign(static_cast<std::size_t>(fine_problem.A.size()), 0);
    const Prolongation P = prolongations(meshes, nodes_of(meshes))[k];
    Level<B> fine = finest_level(fine_problem), coarse;
    fine.clear_phases();
    MinMerge<B> transfer;
    transfer.prepare(fine, P, true, coarse);
    coarse.clear_phases();
    reassemble(transfer, fine, coarse);
    const Eigen::MatrixXd expected = dense(stiffness<D, B>(meshes.levels[k], model));
    EXPECT_LE((dense(coarse.own_matrix) - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(GalerkinOnNestedMeshes, EqualsTheCoarseStiffness) {
  expect_coarse_stiffness<2, 1>(rectangle({0, 0}, {2, 1}, {3, 2}));
  expect_coarse_stiffness<2, 2>(rectangle({0, 0}, {2, 1}, {3, 2}));
  expect_coarse_stiffness<3, 1>(box({0, 0, 0}, {1, 1, 2}, {1, 1, 2}));
  expect_coarse_stiffness<3, 3>(box({0, 0, 0}, {1, 1, 2}, {1, 1, 2}));
}

// Two pairs of vectors, each of which a coarse function moves as a whole, and rounding.
TEST(GalerkinOfFloatingBodies, HoldsAFunctionWithoutEnergyByAWeakSpring) {
  DiscreteProblem<1> problem;
  problem.A.row = {0, 2, 4, 6, 8};
  problem.A.column = {0, 1, 1, 0, 2, 3, 3, 2};
  problem.A.value = {3, -3, std::nextafter(3.0, 4.0), -3, 5, -5, 5, -5};
  problem.b.assign(4, 0);
  problem.fixed.assign(4, 0);
  Prolongation P;
  P.coarse = 2;
  P.row = {0, 1, 2, 3, 4};
  P.column = {0, 0, 1, 1};
  P.weight = {1.0 / 3, 1.0 / 3, 0.7, 0.7};
  P.twin = {-1, -1};
  Level<1> fine = finest_level(problem), coarse;
  fine.clear_phases();
  MinMerge<1> transfer;
  transfer.prepare(fine, P, true, coarse);
  coarse.clear_phases();
  const auto diagonal = [&](const std::vector<Flags>& critical) {
    truncate(fine, critical);
    reassemble(transfer, fine, coarse);
    return std::array{coarse.own_matrix.diagonal(0)[0], coarse.own_matrix.diagonal(1)[0]};
  };
  const double alone = 2 * 3.0 / 9, other = 2 * 5 * 0.49;
  const auto free = diagonal({0, 0, 0, 0});
  EXPECT_NEAR(free[0], 1e-8 * alone, 1e-20);
  EXPECT_NEAR(free[1], 1e-8 * other, 1e-20);
  EXPECT_EQ(coarse.off, std::vector<Flags>(2, 0));
  const auto held = diagonal({1, 0, 1, 1});
  EXPECT_NEAR(held[0], alone / 2, 1e-15);
  EXPECT_EQ(held[1], 1);
  EXPECT_EQ(coarse.off, (std::vector<Flags>{0, 1}));
  EXPECT_EQ(diagonal({0, 0, 0, 0}), free);
}

}  // namespace
}  // namespace signorini::test
