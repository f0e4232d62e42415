// Aggregation with a near null space: every level represents it exactly, and bodies that bend converge like compact
// ones.
#include "amg/coarsening/mode_aggregation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "amg/black_box/nested_start.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "core/base/error.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/weights.hpp"
#include "methods/solve.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

template <int D>
std::vector<double> coordinates(const Mesh<D>& mesh) {
  std::vector<double> out;
  for (const Point<D>& x : mesh.points) out.insert(out.end(), x.begin(), x.end());
  return out;
}

template <int B>
TransferFactory<B> min_merge() {
  return [] { return registry().create<Transfer<B>>("transfer", "min_merge"); };
}

TEST(RigidBodyModes, HaveNoEnergy) {
  const Mesh<2> square = cube<2>(0, 1, 4);
  const Mesh<3> block = cube<3>(3, 4, 3);
  const auto expect_none = [](const auto& A, const NearNullSpace& modes, Index expected) {
    ASSERT_EQ(modes.modes, expected);
    const Eigen::SparseMatrix<double> S = sparse(A);
    for (Index mode = 0; mode < modes.modes; ++mode) {
      Eigen::VectorXd v(S.rows());
      for (Index i = 0; i < S.rows(); ++i) v[i] = modes.at(i)[mode];
      EXPECT_GT(v.norm(), 1);
      EXPECT_LE((S * v).norm(), 1e-13 * S.norm() * v.norm());
    }
  };
  expect_none(stiffness<2, 2>(square, Model<2>{}), rigid_body_modes<2>(coordinates(square)), 3);
  expect_none(stiffness<3, 3>(block, Model<3>{}), rigid_body_modes<3>(coordinates(block)), 6);
}

/// Goes down with the modes as far as they make progress and compares P N_c with N on every level.
template <int B>
void expect_exact(const DiscreteProblem<B>& problem, NearNullSpace modes) {
  Level<B> fine = finest_level(problem);
  fine.clear_phases();
  Index group = 1;
  for (int depth = 0; depth < 3 && fine.vectors / group > 30; ++depth) {
    ModeAggregation found = mode_aggregation<B>(fine, modes, group);
    const Prolongation& P = found.prolongation;
    EXPECT_LT(P.coarse, P.fine());
    double largest = 0;
    for (const double value : modes.value) largest = std::max(largest, std::fabs(value));
    weights::with<B>(P, [&](const auto& weight) {
      for (Index p = 0; p < P.fine(); ++p)
        for (Index mode = 0; mode < modes.modes; ++mode) {
          double value[B] = {};
          for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
            double coarse[B];
            for (int i = 0; i < B; ++i) coarse[i] = found.coarse.at(Offset{P.column[k]} * B + i)[mode];
            weight(k).add_value(coarse, value);
          }
          for (int i = 0; i < B; ++i)
            ASSERT_NEAR(value[i], modes.at(Offset{p} * B + i)[mode], 1e-9 * largest) << depth << " " << p;
        }
    });
    Level<B> coarse;
    const auto transfer = min_merge<B>()();
    transfer->prepare(fine, P, true, coarse);
    coarse.clear_phases();
    reassemble(*transfer, fine, coarse);
    coarse.A = &coarse.own_matrix;
    modes = std::move(found.coarse);
    group = found.group;
    Level<B> next = std::move(coarse);
    fine = std::move(next);
    fine.A = &fine.own_matrix;
  }
}

template <int B>
DiscreteProblem<B> free_problem(BlockMatrix<B> A) {
  DiscreteProblem<B> problem;
  problem.b.assign(static_cast<std::size_t>(A.size()) * B, 0.0);
  problem.start = problem.b;
  problem.fixed.assign(static_cast<std::size_t>(A.size()), 0);
  problem.A = std::move(A);
  return problem;
}

TEST(ModeAggregation, RepresentsRigidBodyModesOnAllLevels) {
  const Mesh<2> square = rectangle({0, 0}, {1, 1}, {30, 30}), strip = rectangle({0, 0}, {100, 1}, {40, 20});
  const Mesh<3> block = cube<3>(0, 1, 9);
  for (const Mesh<2>* mesh : {&square, &strip})
    expect_exact<2>(free_problem(stiffness<2, 2>(*mesh, Model<2>{})), rigid_body_modes<2>(coordinates(*mesh)));
  expect_exact<3>(free_problem(stiffness<3, 3>(block, Model<3>{})), rigid_body_modes<3>(coordinates(block)));
}

// A = S L S with a graph Laplacian L has the energy zero in the direction S^-1 1.
TEST(ModeAggregation, RepresentsScaledConstantsOfScalarProblems) {
  const Eigen::SparseMatrix<double> L = neumann_laplacian(40);
  NearNullSpace modes{1, waves(static_cast<std::size_t>(L.rows()))};
  Eigen::VectorXd scale(L.rows());
  for (Index i = 0; i < L.rows(); ++i) scale[i] = 1 / (modes.value[i] += 1.5);
  expect_exact<1>(problem_of(scale.asDiagonal() * L * scale.asDiagonal()), modes);
}

template <int D>
Model<D> cantilever(double load) {
  Model<D> model;
  model.poisson = 0.3;
  Fix<D> fix{on("left"), {}};
  for (int i = 0; i < D; ++i) fix.value[i] = Field(0);
  model.fixes.push_back(fix);
  Load<D> weight{{}, {}};
  for (int i = 0; i < D; ++i) weight.value[i] = Field(i == D - 1 ? -load : 0.0);
  model.loads.push_back(weight);
  Point<D> up{}, floor{};
  up[D - 1] = 1;
  floor[D - 1] = -0.5;
  model.obstacles.push_back({plane<D>(floor, up), on("bottom"), "test"});
  return model;
}

/// Cycles; energies fall, and the solution is that of the reference solver.
template <int D>
int cycles(const Mesh<D>& mesh, const Model<D>& model) {
  DiscreteProblem<D> problem = discretize<D, D>(mesh, model).problem;
  const AlgebraicLevels<D> levels = algebraic_hierarchy<D>(
      problem, min_merge<D>(), 40, {.coarsening = Coarsening::aggregation}, rigid_body_modes<D>(coordinates(mesh)));
  EXPECT_GE(levels.prolongations.size(), 2u);
  problem.galerkin = levels.matrices;
  std::vector<double> x = nested_start<D>(problem, levels.prolongations, {}, registry());
  const Summary s = solve<D>(problem, levels.prolongations, x, {}, registry());
  EXPECT_TRUE(s.converged()) << s.reason;
  for (std::size_t k = 1; k < s.history.size(); ++k)
    EXPECT_LE(s.history[k].energy, s.history[k - 1].energy + 1e-12 * std::abs(s.energy));
  const Reference exact = reference(problem);
  EXPECT_GT(exact.active(), 0);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-5 * exact.x.norm());
  return s.iterations;
}

TEST(ModeAggregation, SolvesBeamsThatBendOntoAnObstacle) {
  for (const Index cells : {8, nightly(16, 12)})
    EXPECT_LE(cycles<2>(rectangle({0, 0}, {10, 1}, {10 * cells, cells}), cantilever<2>(1e-4)), 30) << cells;
  EXPECT_LE(cycles<2>(rectangle({0, 0}, {100, 1}, {32, 32}), cantilever<2>(1e-6)), 30);
  EXPECT_LE(cycles<3>(box({0, 0, 0}, {10, 1, 1}, {30, 3, 3}), cantilever<3>(1e-4)), 30);
}

TEST(ModeAggregation, SolvesContactWithFrames) {
  const auto model = pressed_block<3>(sphere<3>({0.4, 0.6, -2}, 2.0), 0.02);
  EXPECT_LE(cycles<3>(cube<3>(0, 1, 8), model), 35);
}

TEST(BlackBoxWithANearNullSpace, SolvesTheSameProblemInFewerCycles) {
  const Mesh<2> mesh = rectangle({0, 0}, {10, 1}, {160, 16});
  const DiscreteProblem<2> problem = discretize<2, 2>(mesh, cantilever<2>(1e-4)).problem;
  const Given<2> given(problem);
  SolverOptions options;
  options.coarsening = "aggregation";
  NearNullSpace modes = rigid_body_modes<2>(coordinates(mesh));
  for (Index mode = 0; mode < modes.modes; ++mode) {  // the matrix is in local coordinates
    std::vector<double> v(problem.b.size());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = modes.at(static_cast<Offset>(i))[mode];
    v = to_local(problem, std::move(v));
    for (std::size_t i = 0; i < v.size(); ++i) modes.at(static_cast<Offset>(i))[mode] = v[i];
  }
  BlackBox plain(given.A, 2, options), with_modes(given.A, 2, options, modes);
  const auto a = plain.solve(given.b, given.lower, given.upper),
             b = with_modes.solve(given.b, given.lower, given.upper);
  EXPECT_TRUE(b.summary.converged()) << b.summary.reason;
  EXPECT_LE(2 * b.summary.iterations, a.summary.iterations);
  EXPECT_NEAR(a.summary.energy, b.summary.energy, 1e-8 * std::abs(a.summary.energy));
}

// Directions that are none, that depend on each other or that mean nothing cost cycles only.
TEST(BlackBoxWithANearNullSpace, SolvesWithWhateverIsGiven) {
  const Eigen::SparseMatrix<double> A = laplacian(40);
  const auto n = static_cast<std::size_t>(A.rows());
  DiscreteProblem<1> problem = problem_of(A);
  problem.b.assign(n, -1e-3);
  bound(problem, std::vector<double>(n, -0.05), std::vector<double>(n, infinity));
  const Given<1> given(problem);
  const Reference exact = reference(problem);
  SolverOptions options;
  options.coarsening = "aggregation";
  Random random(86);
  NearNullSpace noise{3, std::vector<double>(3 * n)};
  for (double& value : noise.value) value = random.between(-1, 1);
  for (const NearNullSpace& modes :
       {NearNullSpace{1, std::vector<double>(n, 0.0)}, NearNullSpace{2, std::vector<double>(2 * n, 1.0)},
        NearNullSpace{1, std::vector<double>(n, 1e200)}, noise}) {
    const auto found = BlackBox(A, 1, options, modes).solve(given.b, given.lower);
    EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
    EXPECT_LE((vector(found.x) - exact.x).norm(), 1e-6 * exact.x.norm());
  }
}

TEST(BlackBoxWithANearNullSpace, RefusesWhatDoesNotFit) {
  const Eigen::SparseMatrix<double> A = laplacian(4);
  SolverOptions options;
  const auto message = [&](const NearNullSpace& modes) -> std::string {
    try {
      BlackBox(A, 1, options, modes);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input);
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  const NearNullSpace ones{1, std::vector<double>(9, 1.0)};
  options.coarsening = "classical";
  EXPECT_THAT(message(ones), HasSubstr("expected coarsening 'auto' or 'aggregation'"));
  options.coarsening = "auto";
  EXPECT_EQ(message(ones), "");
  EXPECT_THAT(message({1, std::vector<double>(8, 1.0)}), HasSubstr("found 8 values, expected 9"));
  EXPECT_THAT(message({0, std::vector<double>(9, 1.0)}), HasSubstr("found 0 modes"));
  EXPECT_THAT(message({1, std::vector<double>(9, NAN)}), HasSubstr("expected a finite number"));
}

}  // namespace
}  // namespace signorini::test
