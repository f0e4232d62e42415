// Matrices of fourth order are recognised by themselves, and their levels take as few cycles as those of second order.
#include "amg/coarsening/fourth_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "amg/black_box.hpp"
#include "amg/coarsening/classical.hpp"
#include "core/solver/smooth_interpolation.hpp"
#include "tests/amg/plates.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

std::optional<BlockMatrix<1>> root(const Eigen::SparseMatrix<double>& A) {
  const DiscreteProblem<1> problem = problem_of(A);
  return second_order_root(problem.A, problem.fixed);
}

TEST(SecondOrderRoot, OfASupportedPlateIsTheLaplacian) {
  const auto L = root(plate(9, false));
  ASSERT_TRUE(L);
  EXPECT_LE((Eigen::MatrixXd(sparse(*L)) - Eigen::MatrixXd(laplacian(10))).norm(), 1e-12);
}

TEST(SecondOrderRoot, IsThatOfPlatesAndBeamsAlone) {
  EXPECT_TRUE(root(plate(20, true)));
  EXPECT_TRUE(root(five_diagonals(100, 6)));
  EXPECT_FALSE(root(five_diagonals(100, 12)));  // far from singular: sweeps do
  EXPECT_FALSE(root(laplacian(20)));
  EXPECT_FALSE(root(neumann_laplacian(20)));
  Eigen::SparseMatrix<double> mass = laplacian(20);
  for (Eigen::Index k = 0; k < mass.nonZeros(); ++k) mass.valuePtr()[k] = std::abs(mass.valuePtr()[k]);
  EXPECT_FALSE(root(mass));
  // Bilinear elements, three times as long as wide: couplings of both signs, but of second order.
  std::vector<Eigen::Triplet<double>> entries;
  const auto coupling = [](int di, int dj) {
    const double k[] = {4, -2}, m[] = {8, 2};  // stiffness and mass along one line, per distance
    return k[std::abs(di)] * m[std::abs(dj)] / 3 + 3 * m[std::abs(di)] * k[std::abs(dj)];
  };
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj)
          if (i + di >= 0 && i + di < 20 && j + dj >= 0 && j + dj < 20)
            entries.emplace_back(i * 20 + j, (i + di) * 20 + j + dj, coupling(di, dj));
  Eigen::SparseMatrix<double> stretched(400, 400);
  stretched.setFromTriplets(entries.begin(), entries.end());
  EXPECT_FALSE(root(stretched));
}

TEST(RoundedOff, KeepsLinearFunctionsAndPositiveWeights) {
  constexpr int n = 101;
  const DiscreteProblem<1> problem = problem_of(five_diagonals(n, 6));
  const auto L = second_order_root(problem.A, problem.fixed);
  ASSERT_TRUE(L);
  const Prolongation hats = classical_interpolation(*L, problem.fixed, true);
  EXPECT_NEAR(hats.coarse, n / 2, 1);
  const Prolongation P = rounded_off(*L, problem.fixed, hats, 0.5);
  EXPECT_TRUE(is_smooth(P));
  EXPECT_FALSE(is_smooth(hats));
  EXPECT_EQ(P.twin, hats.twin);
  for (Index p = 4; p < n - 4; ++p) {
    double one = 0, place = 0;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      EXPECT_GT(P.weight[k], 0);
      one += P.weight[k];
      place += P.weight[k] * P.twin[P.column[k]];
    }
    EXPECT_NEAR(one, 1, 1e-13);
    EXPECT_NEAR(place, p, 1e-11);
  }
}

/// x (cells - x) along each direction, zero at both ends.
std::vector<double> arch(int cells, int dimensions) {
  std::vector<double> out;
  for (int i = 1; i < cells; ++i)
    for (int j = 1; j < (dimensions == 1 ? 2 : cells); ++j)
      out.push_back(static_cast<double>(i * (cells - i)) * (dimensions == 1 ? 1 : j * (cells - j)));
  return out;
}

TEST(FitNearEdges, FollowsWhatFallsOffTowardsThem) {
  constexpr int cells = 20;
  const DiscreteProblem<1> problem = problem_of(laplacian(cells));
  const std::vector<double> v = arch(cells, 2);
  Prolongation P = classical_interpolation(problem.A, problem.fixed, true);
  const auto sums = [&](Index p, const auto& of) {
    double sum = 0;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) sum += P.weight[k] * of(P.column[k]);
    return sum;
  };
  std::vector<double> before;
  for (Index p = 0; p < P.fine(); ++p) before.push_back(sums(p, [](Index) { return 1; }));
  fit_near_edges(v, P);
  const std::vector<double> coarse = at_twins(v, P);
  int fitted = 0;
  for (Index p = 0; p < P.fine(); ++p) {
    const double sum = sums(p, [](Index) { return 1; }), found = sums(p, [&](Index q) { return coarse[q]; });
    if (before[p] > 0.999) {
      EXPECT_EQ(sum, before[p]);
    } else {
      EXPECT_NEAR(found, v[p], 1e-12 * v[p]);
      ++fitted;
    }
  }
  EXPECT_GE(fitted, 4 * (cells - 3));
}

TEST(UnderEvenLoad, IsAboutTheSolution) {
  constexpr int cells = 64;
  const Eigen::SparseMatrix<double> L = laplacian(cells);
  const DiscreteProblem<1> problem = problem_of(L);
  const Prolongation P = classical_interpolation(problem.A, problem.fixed, true);
  Eigen::SparseMatrix<double> interpolation(P.fine(), P.coarse);
  std::vector<Eigen::Triplet<double>> weights;
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) weights.emplace_back(p, P.column[k], P.weight[k]);
  interpolation.setFromTriplets(weights.begin(), weights.end());
  const Eigen::SparseMatrix<double> product = interpolation.transpose() * L * interpolation;
  const std::vector<GalerkinMatrix<1>> matrices = {{problem_of(product).A, std::vector<Flags>(P.coarse, 0)}};
  const Eigen::VectorXd v = vector(under_even_load(problem.A, problem.fixed, std::span(&P, 1), matrices));
  const Eigen::VectorXd exact =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(L).solve(Eigen::VectorXd::Ones(L.rows()));
  EXPECT_LE((v - exact).norm(), 0.02 * exact.norm());
}

TEST(KinkDamping, IsOneHalfOnALineAndOneForFivePoints) {
  constexpr int cells = 64;
  const auto damping = [](const Eigen::SparseMatrix<double>& L, const std::vector<double>& v) {
    const DiscreteProblem<1> problem = problem_of(L);
    Prolongation P = classical_interpolation(problem.A, problem.fixed, true);
    fit_near_edges(v, P);
    return kink_damping(problem.A, problem.fixed, P, v);
  };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < cells - 1; ++i) {
    entries.emplace_back(i, i, 2);
    if (i > 0) entries.emplace_back(i, i - 1, -1), entries.emplace_back(i - 1, i, -1);
  }
  Eigen::SparseMatrix<double> line(cells - 1, cells - 1);
  line.setFromTriplets(entries.begin(), entries.end());
  EXPECT_EQ(damping(line, arch(cells, 1)), 0.5);
  EXPECT_EQ(damping(laplacian(cells), arch(cells, 2)), 1);
}

Eigen::VectorXd by_reference(const Eigen::SparseMatrix<double>& A, const std::vector<double>& b,
                             const std::vector<double>& lower) {
  DiscreteProblem<1> problem = problem_of(A);
  problem.b = b;
  bound(problem, lower, std::vector<double>(b.size(), infinity));
  return reference(problem).x;
}

/// Cycles alone find the solution, and their energy falls.
void expect_few_cycles(const Eigen::SparseMatrix<double>& A, const std::vector<double>& b,
                       const std::vector<double>& lower, const Eigen::VectorXd& solution) {
  const auto n = static_cast<std::size_t>(A.rows());
  const std::vector<double> upper(n, infinity);
  BlackBox solver(A);
  const BlackBox::Result found = solver.solve(b, lower, upper);
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_LE(found.summary.iterations, 30);
  for (const Stage& stage : found.summary.stages) EXPECT_EQ(stage.linear_solves, 0) << stage.method;
  const Eigen::VectorXd e = vector(found.x) - solution;
  EXPECT_LE(e.dot(A * e), 1e-14 * vector(found.x).dot(A * vector(found.x)));
  double energy = infinity;
  for (const IterationRecord& cycle : found.summary.history) {
    EXPECT_LE(cycle.energy, energy + 1e-12 * std::abs(energy));
    energy = cycle.energy;
  }
}

TEST(FourthOrder, PlatesTakeFewCycles) {
  for (const auto& [nodes, clamped] : {std::pair(33, true), {65, true}, {33, false}, {65, false}}) {
    SCOPED_TRACE(nodes);
    const double h = 1.0 / (nodes + 1);
    const auto n = static_cast<std::size_t>(nodes) * nodes;
    const Eigen::SparseMatrix<double> A = plate(nodes, clamped);
    const std::vector<double> b(n, (clamped ? -3000 : -1000) * std::pow(h, 4)), lower(n, -1.0);
    expect_few_cycles(A, b, lower, by_reference(A, b, lower));
  }
}

/// Cycles alone solve it, as far as rounding allows.
void expect_few_cycles(const Eigen::SparseMatrix<double>& A, double load, int most, double contact) {
  const auto n = static_cast<std::size_t>(A.rows());
  SolverOptions options;
  options.max_iterations = 40;
  BlackBox solver(A, 1, options);
  const BlackBox::Result found =
      solver.solve(std::vector<double>(n, load), std::vector<double>(n, -1.0), std::vector<double>(n, infinity));
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_LE(found.summary.stages.front().iterations, most);
  EXPECT_LE(found.summary.algebraic_error, 2e-8);
  const auto touching = static_cast<double>(std::ranges::count(found.active, -1));
  EXPECT_NEAR(touching / static_cast<double>(n), contact, 2e-3);
}

TEST(FourthOrder, CyclesDoNotGrowWithSupportedPlates) {
  for (const int nodes : {33, 65, 129}) {
    SCOPED_TRACE(nodes);
    const double contact = nodes == 33 ? 77 : nodes == 65 ? 257 : 909;
    expect_few_cycles(plate(nodes, false), -1000 * std::pow(nodes + 1, -4), 20, contact / (nodes * nodes));
  }
}

// What presses the longer one is below what rounding does to the terms of a row: 1e-15, beside 16.
TEST(FourthOrder, BeamsWhoseLoadsDrownInRoundingAreSolved) {
  for (const int n : {5000, 40000}) {
    SCOPED_TRACE(n);
    expect_few_cycles(five_diagonals(n, 6), -3000 * std::pow(n + 1, -4), 20, 0.2135);
  }
}

// CHENHARK by its formula, and the load of PENTDI on a beam. Both are solved by one on the first half, zero elsewhere.
TEST(FourthOrder, BeamsTakeFewCycles) {
  for (const int n : {1000, 5000}) {
    SCOPED_TRACE(n);
    const int half = n / 2, degenerate = n == 1000 ? 200 : 500;
    Eigen::VectorXd ones = Eigen::VectorXd::Zero(n);
    ones.head(half).setOnes();
    const Eigen::SparseMatrix<double> A = five_diagonals(n, 6);
    Eigen::VectorXd b = A * ones;
    b.tail(n - half - degenerate).array() -= 1;
    expect_few_cycles(A, std::vector<double>(b.begin(), b.end()), std::vector<double>(n, 0.0), ones);
    b.setZero();
    b[0] = 3, b[1] = -1, b[half - 2] = -1, b[half - 1] = 3, b[half] = -4;
    b.tail(n - half - 2).setConstant(-1);
    expect_few_cycles(A, std::vector<double>(b.begin(), b.end()), std::vector<double>(n, 0.0), ones);
  }
}

}  // namespace
}  // namespace signorini::test
