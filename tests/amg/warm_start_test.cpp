// A start costs no cycles, whatever it is, and saves them where it is close.
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

struct Change {
  std::vector<double> b, lower;
};

/// @param on_all_levels counts those of the nested start, too
int cycles(BlackBox& solver, const Change& problem, const std::vector<double>& start = {},
           int* on_all_levels = nullptr) {
  const auto count = [&](const IterationRecord&) {
    if (on_all_levels) ++*on_all_levels;
    return true;
  };
  const auto result = solver.solve(problem.b, problem.lower, {}, start, count);
  EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
  return result.summary.iterations;
}

void add_to(std::vector<double>& values, double summand) {
  for (double& v : values) v += summand;
}

void scale(std::vector<double>& values, double factor) {
  for (double& v : values) v *= factor;
}

/// @param size of a bound
void expect_few_cycles_after_changes(BlackBox& solver, const Change& before, double size) {
  const std::vector<double> x = solver.solve(before.b, before.lower).x;
  for (const double change : {1e-8, 1e-6, 1e-4, 1e-2, 1e-1, 1.0, -1e-8, -1e-6, -1e-4, -1e-2, -1e-1, -1.0}) {
    SCOPED_TRACE(change);
    Change moved = before, loaded = before;
    add_to(moved.lower, change * size);
    scale(loaded.b, 1 + change);
    for (const Change& after : {moved, loaded}) {
      int all_warm = 0, all_cold = 0;
      const int warm = cycles(solver, after, x, &all_warm), cold = cycles(solver, after, {}, &all_cold);
      EXPECT_LE(warm, cold + 1);
      EXPECT_TRUE(std::abs(change) >= 0.5 || all_warm <= all_cold + 2);  // one nested iteration, too
      EXPECT_TRUE(std::abs(change) >= 1e-5 || warm <= cold - 2);
      EXPECT_TRUE(std::abs(change) >= 1e-7 || warm <= cold / 2);
    }
  }
  int again = 0;
  cycles(solver, before, x, &again);
  EXPECT_EQ(again, 1) << "on all levels, where nothing has changed";
  for (const double change : {1e-3, -1e-3}) {  // loads: coarser levels are not asked
    SCOPED_TRACE(change);
    Change loaded = before;
    scale(loaded.b, 1 + change);
    int all_warm = 0, all_cold = 0;
    const int warm = cycles(solver, loaded, x, &all_warm);
    cycles(solver, loaded, {}, &all_cold);
    EXPECT_EQ(all_warm, warm);
    EXPECT_LE(3 * all_warm, 2 * all_cold);
  }
}

TEST(WarmStart, TakesFewCyclesAfterAnyChangeOfAMembrane) {
  const Matrix A = laplacian(100);
  const std::vector<double> b(static_cast<std::size_t>(A.rows()), -1e-4);
  std::vector<double> lower(b.size(), -0.04);
  BlackBox solver(A);
  expect_few_cycles_after_changes(solver, {b, lower}, 0.04);
}

TEST(WarmStart, KnowsTheContactOfTheStart) {
  const Matrix A = laplacian(100);
  Change problem{std::vector<double>(static_cast<std::size_t>(A.rows()), -1e-4), {}};
  problem.lower.assign(problem.b.size(), -0.04);
  BlackBox solver(A);
  const std::vector<double> x = solver.solve(problem.b, problem.lower).x;
  const auto again = solver.solve(problem.b, problem.lower, {}, x).summary.history;
  EXPECT_GT(again.front().levels.back().critical, 1000);
  EXPECT_EQ(again.front().levels.back().changed, 0) << "where nothing has changed";
  scale(problem.b, 1.01);
  int all_warm = 0, all_cold = 0;
  cycles(solver, problem, x, &all_warm);
  cycles(solver, problem, {}, &all_cold);
  EXPECT_LE(2 * all_warm, all_cold);
}

TEST(WarmStart, TakesFewCyclesAfterAnyChangeOfAnElasticBody) {
  const Mesh<2> mesh = cube<2>(0, 1, 48);
  Matrix A = sparse(stiffness<2, 2>(mesh, Model<2>{}));
  std::vector<double> b(static_cast<std::size_t>(A.rows()), 0), lower(b.size(), -infinity);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const auto [x, y] = std::pair(mesh.points[p][0], mesh.points[p][1]);
    b[2 * p + 1] = -1 / static_cast<double>(mesh.points.size());
    if (y == 0) lower[2 * p + 1] = -0.05 - 0.5 * (x - 0.5) * (x - 0.5);
    if (y == 1)  // springs
      for (const std::size_t i : {2 * p, 2 * p + 1})
        A.coeffRef(static_cast<Index>(i), static_cast<Index>(i)) += 1.0 / 48;
  }
  BlackBox solver(A, 2);
  expect_few_cycles_after_changes(solver, {b, lower}, 0.05);
}

// The bounds leave the solution by and by, as in docs/black_box_programs.md.
TEST(WarmStart, FollowsASinkingFloorOnGivenLevels) {
  const auto interpolation = [](int n) {
    Matrix P(n, n / 2);
    for (int i = 0; i < n / 2; ++i) {
      P.insert(2 * i, i) = P.insert(2 * i + 2, i) = 0.5;
      P.insert(2 * i + 1, i) = 1;
    }
    return P;
  };
  constexpr int n = (1 << 12) - 1;
  Matrix A(n, n);
  for (int i = 0; i < n; ++i) {
    A.insert(i, i) = 2.0 * (n + 1);
    if (i > 0) A.insert(i, i - 1) = A.insert(i - 1, i) = -1.0 * (n + 1);
  }
  std::vector<SparseRows> interpolations;
  for (int fine = 15; fine <= n; fine = 2 * fine + 1) interpolations.emplace_back(interpolation(fine));
  BlackBox solver(A, interpolations);
  const std::vector<double> load(n, -1.0 / (n + 1));
  std::vector<double> x;
  for (const double floor : {-0.03, -0.06, -0.12}) {
    const std::vector<double> lower(n, floor);
    EXPECT_LE(cycles(solver, {load, lower}, x), cycles(solver, {load, lower}) + 1) << floor;
    x = solver.solve(load, lower).x;
  }
}

/// All cycles of solves one after the other, each from the last solution.
int cycles_of_sequence(BlackBox& solver, const std::vector<Change>& problems) {
  std::vector<double> x;
  int all = 0;
  for (std::size_t k = 0; k < problems.size(); ++k) {
    if (k > 1) cycles(solver, problems[k], x, &all);
    x = solver.solve(problems[k].b, problems[k].lower, {}, x).x;
  }
  return all;
}

int cycles_from_nothing(BlackBox& solver, const std::vector<Change>& problems) {
  int all = 0;
  for (std::size_t k = 2; k < problems.size(); ++k) cycles(solver, problems[k], {}, &all);
  return all;
}

// What changed before changes again, by as much, more, less, or back.
TEST(WarmStart, GoesOnAsBefore) {
  const Matrix A = laplacian(100);
  const auto n = static_cast<std::size_t>(A.rows());
  const Change first{std::vector<double>(n, -1e-4), std::vector<double>(n, -0.04)};
  std::vector<Change> grows, swings, rises;
  for (int k = 0; k < 8; ++k) {
    for (auto* to : {&grows, &swings, &rises}) to->push_back(first);
    scale(grows.back().b, 1 + 1e-3 * k);
    scale(swings.back().b, 1 + 1e-3 * std::cos(2.0 * k * k));
    add_to(rises.back().lower, 4e-5 * k);
  }
  for (const auto& [problems, part] : {std::pair(&grows, 0.4), {&swings, 0.4}, {&rises, 0.6}}) {
    BlackBox solver(A);
    EXPECT_LE(cycles_of_sequence(solver, *problems), part * cycles_from_nothing(solver, *problems));
  }
}

TEST(WarmStart, TakesFewCyclesFromAnyVector) {
  const Matrix A = laplacian(100);
  const auto n = static_cast<std::size_t>(A.rows());
  const std::vector<double> b(n, -1e-4), lower(n, -0.04);
  BlackBox solver(A);
  const int cold = cycles(solver, {b, lower});
  Random random(91);
  for (const double size : {1e-4, 1e-2, 1.0, 1e4}) {
    std::vector<double> start(n);
    for (double& v : start) v = random.between(-size, size);
    EXPECT_LE(cycles(solver, {b, lower}, start), cold + 1) << size;
  }
  EXPECT_LE(cycles(solver, {b, lower}, std::vector<double>(n, 0)), cold + 1);
}

}  // namespace
}  // namespace signorini::test
