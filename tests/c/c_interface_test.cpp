// The plain C interface: results are those of the class, errors are statuses with a message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "c/signorini.h"
#include "tests/amg/membrane.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

struct CInterface : testing::Test {
  const SparseRows A = laplacian(40);
  const std::size_t n = static_cast<std::size_t>(A.rows);
  std::vector<double> b = std::vector<double>(n, -1.0 / 1600), lower = std::vector<double>(n, -0.03);
  std::vector<double> x = std::vector<double>(n, 7), multiplier = x;
  signorini_solver* solver = nullptr;

  void TearDown() override { signorini_destroy(solver); }
  int create() { return signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 1, &solver); }
};

TEST_F(CInterface, GivesWhatTheClassGives) {
  ASSERT_EQ(create(), SIGNORINI_SOLVED) << signorini_message();
  signorini_summary summary;
  ASSERT_EQ(
      signorini_solve(solver, b.data(), lower.data(), nullptr, nullptr, 1e-8, x.data(), multiplier.data(), &summary),
      SIGNORINI_SOLVED);
  EXPECT_THAT(signorini_message(), HasSubstr("are at most 1.000e-08"));
  const BlackBox::Result expected = BlackBox(A).solve(b, lower);
  EXPECT_EQ(x, expected.x);
  EXPECT_EQ(multiplier, expected.multiplier);
  EXPECT_EQ(summary.iterations, expected.summary.iterations);
  EXPECT_EQ(summary.levels, std::ssize(expected.summary.level_unknowns));
  EXPECT_EQ(summary.energy, expected.summary.energy);
}

TEST_F(CInterface, TakesRowsOfEitherWidth) {
  const std::vector<std::int32_t> row(A.row.begin(), A.row.end());
  ASSERT_EQ(signorini_create(A.rows, row.data(), A.column.data(), A.value.data(), 1, &solver), SIGNORINI_SOLVED);
  ASSERT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_SOLVED);
  EXPECT_EQ(x, BlackBox(A).solve(b).x);
}

TEST_F(CInterface, SolvesToTheToleranceGiven) {
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  for (const double tolerance : {1e-2, 1e-11}) {
    signorini_summary summary;
    ASSERT_EQ(signorini_solve(solver, b.data(), lower.data(), nullptr, nullptr, tolerance, x.data(), nullptr, &summary),
              SIGNORINI_SOLVED);
    EXPECT_LE(summary.algebraic_error, tolerance);
    EXPECT_GE(summary.algebraic_error, tolerance < 1e-6 ? 0 : 1e-9);
  }
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 0, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("tolerance"));
}

TEST_F(CInterface, SaysWhatIsWrongWithTheMatrix) {
  SparseRows broken = A;
  broken.value[1] = 5;
  solver = reinterpret_cast<signorini_solver*>(&broken);
  EXPECT_EQ(signorini_create64(A.rows, broken.row.data(), broken.column.data(), broken.value.data(), 1, &solver),
            SIGNORINI_BAD_INPUT);
  EXPECT_EQ(solver, nullptr);
  EXPECT_THAT(signorini_message(), HasSubstr("not symmetric"));
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 4, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("block: found 4"));
}

TEST_F(CInterface, RefusesNullWhereAnArrayIsNeeded) {
  EXPECT_EQ(signorini_create64(A.rows, nullptr, A.column.data(), A.value.data(), 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), nullptr, A.value.data(), 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), nullptr, 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("value: is null"));
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 1, nullptr), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_solve(nullptr, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  EXPECT_EQ(signorini_solve(solver, nullptr, nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, nullptr, nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  signorini_destroy(nullptr);
}

TEST_F(CInterface, TellsWhereThereIsNoSolutionAndLeavesTheArraysAlone) {
  const std::vector<double> before = x;
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  std::vector<double> upper(n, -1);
  EXPECT_EQ(signorini_solve(solver, b.data(), lower.data(), upper.data(), nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_NO_SOLUTION);
  EXPECT_THAT(signorini_message(), HasSubstr("infeasible bounds"));
  signorini_destroy(solver);
  const SparseRows floating = neumann_laplacian(10);
  b.assign(121, 1.0);
  ASSERT_EQ(
      signorini_create64(floating.rows, floating.row.data(), floating.column.data(), floating.value.data(), 1, &solver),
      SIGNORINI_SOLVED);
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_NO_SOLUTION);
  EXPECT_THAT(signorini_message(), HasSubstr("unbounded"));
  EXPECT_EQ(x, before);
}

signorini_rows rows_of(const SparseRows& A) {
  return {A.rows, A.columns, A.row.data(), A.column.data(), A.value.data()};
}

/// From every second unknown and its neighbour.
Eigen::SparseMatrix<double> pairs(int n) {
  Eigen::SparseMatrix<double> P(n, (n + 1) / 2);
  for (int i = 0; i < n; ++i) P.insert(i, i / 2) = 1;
  return P;
}

struct CSetup : CInterface {
  const signorini_rows matrix = rows_of(A);
  signorini_setup setup = SIGNORINI_SETUP;

  int create_with() { return signorini_create_with(&matrix, 1, &setup, &solver); }
  int solve() {
    return signorini_solve(solver, b.data(), lower.data(), nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr);
  }
  void expect_refused(const char* message) {
    EXPECT_EQ(create_with(), SIGNORINI_BAD_INPUT) << message;
    EXPECT_EQ(solver, nullptr);
    EXPECT_THAT(signorini_message(), HasSubstr(message));
  }
};

TEST_F(CSetup, OfNothingIsTheDefault) {
  ASSERT_EQ(signorini_create_with(&matrix, 1, nullptr, &solver), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  EXPECT_EQ(x, BlackBox(A).solve(b, lower).x);
  signorini_destroy(solver);
  EXPECT_EQ(signorini_create_with(nullptr, 1, nullptr, &solver), SIGNORINI_BAD_INPUT);
}

// The struct grows at its end: programs know less of it, or more, than the library.
TEST_F(CSetup, IsAsLongAsItSays) {
  setup.size = 0;
  expect_refused("setup.size: found 0, expected sizeof(signorini_setup)");
  struct {
    signorini_setup known = SIGNORINI_SETUP;
    double unknown = 0;
  } later;
  later.known.size = sizeof later;
  ASSERT_EQ(signorini_create_with(&matrix, 1, &later.known, &solver), SIGNORINI_SOLVED) << signorini_message();
  signorini_destroy(solver);
  solver = nullptr;
  later.unknown = 1;
  EXPECT_EQ(signorini_create_with(&matrix, 1, &later.known, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("setup: uses members that this library"));
}

TEST_F(CSetup, TakesOptionsOfAllTypes) {
  const char* settings[] = {"reassemble = false", "relaxation=1", "pre=3", "cycle=\"W\"", nullptr};
  setup.settings = settings;
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  const SolverOptions options{.cycle = "W", .pre = 3, .relaxation = 1, .reassemble = false};
  EXPECT_EQ(x, BlackBox(A, 1, options).solve(b, lower).x);
  signorini_destroy(solver);
  solver = nullptr;
  const std::pair<const char*, const char*> wrong[] = {{"reassemble=1", "expected true or false"},
                                                       {"pre=3.5", "expected a whole number"},
                                                       {"relaxation=2", "expected a number in (0, 2)"},
                                                       {"smoother=forwart", "there is no smoother 'forwart'"}};
  for (const auto& [setting, message] : wrong) {
    settings[0] = setting;
    expect_refused(message);
  }
}

TEST_F(CSetup, TakesTheOptionsOfTheSolver) {
  const char* settings[] = {"method=tnnmg", "max_iterations=2", nullptr};
  setup.settings = settings;
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  EXPECT_EQ(solve(), SIGNORINI_ITERATION_LIMIT);
  EXPECT_EQ(x, BlackBox(A, 1, {.max_iterations = 2, .method = "tnnmg"}).solve(b, lower).x);
  signorini_destroy(solver);
  solver = nullptr;
  for (const char* wrong : {"metod=tnnmg", "method=magic", "start=zero", "method"}) {
    settings[0] = wrong;
    expect_refused(wrong);
    EXPECT_THAT(signorini_message(), testing::StartsWith("solver."));
  }
}

// Active sets cannot go on where nothing holds the free part: the program's exit status is 3.
TEST_F(CSetup, TellsWhereTheMethodCannotGoOn) {
  const SparseRows floating = neumann_laplacian(10);
  const signorini_rows rows = rows_of(floating);
  const char* settings[] = {"method=pdas", nullptr};
  setup.settings = settings;
  ASSERT_EQ(signorini_create_with(&rows, 1, &setup, &solver), SIGNORINI_SOLVED) << signorini_message();
  b.assign(121, 0.0);
  b.front() = 1;
  b.back() = -1;
  lower.assign(121, -100);
  x.assign(121, 7);
  const BlackBox::Result expected = BlackBox(floating, 1, {.method = "pdas"}).solve(b, lower);
  ASSERT_THAT(expected.summary.outcome, testing::AnyOf(Outcome::stuck, Outcome::failed)) << expected.summary.reason;
  EXPECT_EQ(solve(), SIGNORINI_ITERATION_LIMIT);
  EXPECT_EQ(signorini_message(), expected.summary.reason);
  EXPECT_EQ(x, expected.x);
}

TEST_F(CSetup, TakesTheLevelsOfAnotherCode) {
  const int unknowns = A.rows;
  const std::vector<SparseRows> P{pairs((unknowns + 1) / 2), pairs(unknowns)};
  const std::vector<signorini_rows> interpolations{rows_of(P[0]), rows_of(P[1])};
  setup.levels = 2;
  expect_refused("interpolations: is null");
  setup.interpolations = interpolations.data();
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  EXPECT_EQ(x, BlackBox(A, P).solve(b, lower).x);
  signorini_destroy(solver);
  solver = nullptr;
  const std::vector<signorini_rows> wrong{matrix, matrix};
  setup.coarse_matrices = wrong.data();
  expect_refused("coarse matrix 1 of 2");
}

TEST_F(CSetup, TakesDirectionsOfLittleEnergy) {
  std::vector<double> modes(n);
  for (std::size_t i = 0; i < n; ++i) modes[i] = 1 + 1e-3 * static_cast<double>(i % 39);
  setup.modes = 1;
  expect_refused("near_null: is null");
  setup.near_null = modes.data();
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  EXPECT_EQ(x, BlackBox(A, 1, {}, NearNullSpace{1, modes}).solve(b, lower).x);
  signorini_destroy(solver);
  solver = nullptr;
  setup.modes = 33;
  expect_refused("modes: found 33, expected 1 to 32");
  setup.modes = 1;
  setup.coordinates = modes.data();
  expect_refused("near_null: given with coordinates");
  setup = SIGNORINI_SETUP;
  setup.coordinates = modes.data();
  expect_refused("coordinates: given for blocks of 1, expected 2 or 3");
}

TEST_F(CSetup, TakesCoordinates) {
  Random random(87);
  const SparseRows blocks = sparse(random_matrix<2>(random, 900));
  std::vector<double> coordinates(1800), load(1800, 1);
  for (double& v : coordinates) v = random.between(-1, 1);
  setup.coordinates = coordinates.data();
  const signorini_rows rows = rows_of(blocks);
  ASSERT_EQ(signorini_create_with(&rows, 2, &setup, &solver), SIGNORINI_SOLVED) << signorini_message();
  x.resize(1800);
  ASSERT_EQ(signorini_solve(solver, load.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_SOLVED);
  // Up to rounding: dense products of Eigen are compiled in both libraries, with and without fused multiplication.
  const std::vector<double> wanted = BlackBox(blocks, 2, {}, rigid_body_modes<2>(coordinates)).solve(load).x;
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-12 * 20), wanted));
}

SparseRows triangle_of(const SparseRows& A, bool lower) {
  SparseRows out;
  out.rows = out.columns = A.rows;
  for (Index i = 0; i < A.rows; ++i) {
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k)
      if (lower ? A.column[k] <= i : A.column[k] >= i) {
        out.column.push_back(A.column[k]);
        out.value.push_back(A.value[k]);
      }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

TEST_F(CSetup, TakesEitherTriangle) {
  const std::vector<double> expected = BlackBox(A).solve(b, lower).x;
  for (const bool low : {false, true}) {
    const SparseRows triangle = triangle_of(A, low);
    const signorini_rows rows = rows_of(triangle);
    setup.one_triangle = 0;
    EXPECT_EQ(signorini_create_with(&rows, 1, &setup, &solver), SIGNORINI_BAD_INPUT);
    EXPECT_THAT(signorini_message(), HasSubstr("where one triangle is given, say so"));
    setup.one_triangle = 1;
    ASSERT_EQ(signorini_create_with(&rows, 1, &setup, &solver), SIGNORINI_SOLVED) << signorini_message();
    ASSERT_EQ(solve(), SIGNORINI_SOLVED);
    EXPECT_LE((vector(x) - vector(expected)).norm(), 1e-12 * vector(expected).norm());
    signorini_destroy(solver);
    solver = nullptr;
  }
  expect_refused("row 1 has an entry above the diagonal and row");
}

int stop_after_two(int iteration, double residual, double algebraic_error, void* data) {
  EXPECT_GE(residual, 0);
  EXPECT_GE(algebraic_error, 0);
  *static_cast<int*>(data) += 1;
  return iteration == 2;
}

TEST_F(CSetup, StopsWhenTheMonitorSaysSo) {
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  int calls = 0;
  ASSERT_EQ(signorini_set_monitor(solver, stop_after_two, &calls), SIGNORINI_SOLVED);
  EXPECT_EQ(solve(), SIGNORINI_INTERRUPTED);
  EXPECT_GE(calls, 2);
  EXPECT_NE(x[n / 2], 7);  // the last iterate
  ASSERT_EQ(signorini_set_monitor(solver, nullptr, nullptr), SIGNORINI_SOLVED);
  EXPECT_EQ(solve(), SIGNORINI_SOLVED);
}

struct Watched {
  signorini_solver* solver;
  std::vector<signorini_cycle> coarse, finest;
};

int keep_cycle(int iteration, double residual, double algebraic_error, void* data) {
  auto& watched = *static_cast<Watched*>(data);
  signorini_cycle cycle;
  EXPECT_EQ(signorini_current_cycle(watched.solver, &cycle), SIGNORINI_SOLVED);
  EXPECT_EQ(cycle.iteration, iteration);
  EXPECT_EQ(cycle.residual, residual);
  EXPECT_EQ(cycle.algebraic_error, algebraic_error);
  (cycle.finest ? watched.finest : watched.coarse).push_back(cycle);
  return 0;
}

// Those of the class, and those that the monitor was told of.
TEST_F(CSetup, KeepsTheCyclesOfTheLastSolve) {
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  std::int32_t count = -1;
  ASSERT_EQ(signorini_history(solver, 0, nullptr, &count), SIGNORINI_SOLVED);
  EXPECT_EQ(count, 0);
  Watched watched{solver, {}, {}};
  ASSERT_EQ(signorini_set_monitor(solver, keep_cycle, &watched), SIGNORINI_SOLVED);
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  const Summary expected = BlackBox(A).solve(b, lower).summary;
  std::vector<signorini_cycle> cycles(expected.history.size());
  ASSERT_EQ(signorini_history(solver, 1000, cycles.data(), &count), SIGNORINI_SOLVED);
  ASSERT_EQ(count, std::ssize(expected.history));
  ASSERT_EQ(watched.finest.size(), cycles.size());
  EXPECT_GE(watched.coarse.size(), 1u);
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    EXPECT_EQ(cycles[k].iteration, expected.history[k].iteration);
    EXPECT_EQ(cycles[k].energy, expected.history[k].energy);
    EXPECT_EQ(cycles[k].contact, expected.history[k].contact_nodes);
    EXPECT_EQ(cycles[k].changed, expected.history[k].changed);
    EXPECT_EQ(cycles[k].finest, 1);
    EXPECT_NEAR(watched.finest[k].energy, cycles[k].energy, 1e-12);  // rounding is taken out at the end
  }
  signorini_cycle first;
  ASSERT_EQ(signorini_history(solver, 1, &first, &count), SIGNORINI_SOLVED);
  EXPECT_EQ(first.energy, cycles[0].energy);
  EXPECT_EQ(signorini_current_cycle(solver, &first), SIGNORINI_BAD_INPUT) << "no monitor is being called";
  EXPECT_EQ(signorini_history(solver, -1, &first, &count), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_history(solver, 1, nullptr, &count), SIGNORINI_BAD_INPUT);
}

TEST_F(CSetup, TakesAnotherMatrix) {
  ASSERT_EQ(create_with(), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  SparseRows other = A;
  for (double& v : other.value) v *= v > 0 ? 4 : 3;
  const signorini_rows rows = rows_of(other);
  ASSERT_EQ(signorini_set_matrix(solver, &rows), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  const std::vector<double> expected = BlackBox(other).solve(b, lower).x, found = x;
  EXPECT_LE((vector(found) - vector(expected)).norm(), 1e-7 * vector(expected).norm());

  other.value[0] = -1;
  EXPECT_EQ(signorini_set_matrix(solver, &rows), SIGNORINI_BAD_INPUT);
  const SparseRows smaller = laplacian(20);
  const signorini_rows few = rows_of(smaller);
  EXPECT_EQ(signorini_set_matrix(solver, &few), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("found 361 rows, expected 1521 as before"));
  ASSERT_EQ(solve(), SIGNORINI_SOLVED);
  EXPECT_EQ(x, found);  // nothing has changed
}

TEST(ActiveInC, IsThatOfTheClass) {
  const Membrane m;
  const SparseRows A = m.A;
  signorini_solver* solver = nullptr;
  ASSERT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 1, &solver), SIGNORINI_SOLVED);
  std::vector<double> x(m.n), multiplier(m.n);
  std::vector<signed char> active(m.n, 9);
  EXPECT_EQ(signorini_active(solver, active.data()), SIGNORINI_BAD_INPUT) << "nothing was solved";
  signorini_summary summary;
  ASSERT_EQ(signorini_solve(solver, m.b.data(), m.lower.data(), m.upper.data(), nullptr, 1e-8, x.data(),
                            multiplier.data(), &summary),
            SIGNORINI_SOLVED);
  ASSERT_EQ(signorini_active(solver, active.data()), SIGNORINI_SOLVED);
  const BlackBox::Result expected = BlackBox(m.A).solve(m.b, m.lower, m.upper);
  EXPECT_EQ(active, expected.active);
  EXPECT_EQ(multiplier, expected.multiplier);
  EXPECT_EQ(summary.limited_by_rounding, 0);
  EXPECT_EQ(signorini_active(solver, nullptr), SIGNORINI_BAD_INPUT);
  signorini_destroy(solver);
}

}  // namespace
}  // namespace signorini::test
