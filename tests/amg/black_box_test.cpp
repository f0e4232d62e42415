// A matrix and bounds alone: the solution is that of an independent solver, whatever the levels are.
#include "amg/black_box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "tests/amg/matrices.hpp"
#include "tests/amg/membrane.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

template <int B>
void expect_solution(BlackBox& solver, const Given<B>& given, const DiscreteProblem<B>& problem) {
  const BlackBox::Result found = solver.solve(given.b, given.lower, given.upper);
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  const Reference exact = reference(problem);
  EXPECT_LE((vector(found.x) - exact.x).norm(), 1e-6 * (exact.x.norm() + 1e-300));
  const Eigen::VectorXd force = given.A * vector(found.x) - vector(given.b);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(force.size());  // exactly, off contact
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (found.x[i] == given.lower[i]) expected[k] += std::max(force[k], 0.0);
    if (found.x[i] == given.upper[i]) expected[k] += std::min(force[k], 0.0);
  }
  EXPECT_LE((vector(found.multiplier) - expected).norm(), 1e-12 * (1 + vector(given.b).norm()));
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    EXPECT_GE(found.x[i], given.lower[i]);
    EXPECT_LE(found.x[i], given.upper[i]);
  }
}

template <int B>
void expect_solution(const DiscreteProblem<B>& problem) {
  const Given<B> given(problem);
  BlackBox solver(given.A, B);
  expect_solution(solver, given, problem);
}

TEST(BlackBox, SolvesRandomProblemsLikeTheReferenceSolver) {
  Random random(81);
  for (int trial = 0; trial < 3; ++trial) {
    expect_solution(random_problem<1>(random, 900));
    expect_solution(random_problem<2>(random, 500));
    expect_solution(random_problem<3>(random, 450));
  }
}

// Prescribed values are rows and columns of the identity, bounds of a quarter are equal, or touched without any force.
TEST(BlackBox, SolvesObstacleProblemsLikeTheReferenceSolver) {
  for (const auto& c : scalar_cases()) {
    SCOPED_TRACE(c.name);
    expect_solution(c.nested.finest());
  }
}

TEST(BlackBox, SolvesContactProblemsLikeTheReferenceSolver) {
  for (const auto& c : plane_cases()) {
    SCOPED_TRACE(c.name);
    expect_solution(c.nested.finest());
  }
  for (const auto& c : space_cases()) {
    SCOPED_TRACE(c.name);
    expect_solution(c.nested.finest());
  }
}

TEST(BlackBox, LevelsOfTheMatrixMakeTheNumberOfCyclesIndependentOfItsSize) {
  for (const int cells : {32, 64, 128}) {
    const Matrix A = laplacian(cells);
    const std::vector<double> b(static_cast<std::size_t>(A.rows()), -1.0 / (cells * cells)), lower(b.size(), -0.03);
    const auto result = BlackBox(A).solve(b, lower);
    EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
    EXPECT_LE(result.summary.iterations, 20) << cells;
    EXPECT_GE(result.summary.level_unknowns.size(), 2u);
  }
}

TEST(BlackBox, TakesTheLevelsOfAnotherCode) {
  for (const auto& c : scalar_cases()) {
    const Given<1> given(c.nested.finest());
    std::vector<SparseRows> interpolations;
    for (const Prolongation& P : c.nested.prolongations)
      interpolations.emplace_back(P.fine(), P.coarse, P.row.data(), P.column.data(), P.weight.data());
    BlackBox solver(given.A, interpolations);
    SCOPED_TRACE(c.name);
    expect_solution(solver, given, c.nested.finest());
    EXPECT_EQ(solver.solve(given.b).summary.level_unknowns.size(), interpolations.size() + 1);
  }
}

Matrix weights_of(const Prolongation& P) {
  Matrix out(P.fine(), P.coarse);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) out.insert(p, P.column[k]) = P.weight[k];
  return out;
}

/// From half as many vectors, with the same weight each.
Matrix pairs(int n, double weight) {
  Matrix out(n, n / 2);
  for (int i = 0; i < n; ++i) out.insert(i, i / 2) = weight;
  return out;
}

/// The Galerkin products of the finest matrix, coarsest first.
std::vector<SparseRows> galerkin_products(Matrix A, const std::vector<Matrix>& interpolations) {
  std::vector<SparseRows> out;
  for (std::size_t k = interpolations.size(); k-- > 0;) {
    A = Matrix(interpolations[k].transpose() * A * interpolations[k]).eval();
    out.insert(out.begin(), SparseRows(A));
  }
  return out;
}

/// The same for each of several components of a vector.
Matrix for_components(const Matrix& P, int components) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < P.outerSize(); ++j)
    for (Matrix::InnerIterator it(P, j); it; ++it)
      for (int i = 0; i < components; ++i)
        entries.emplace_back(static_cast<int>(it.row()) * components + i, j * components + i, it.value());
  Matrix out(P.rows() * components, P.cols() * components);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// They are what would have been computed, but for rounding.
TEST(BlackBox, TakesTheMatricesOfAnotherCode) {
  for (const auto& c : scalar_cases()) {
    SCOPED_TRACE(c.name);
    const Given<1> given(c.nested.finest());
    std::vector<Matrix> weights;
    for (const Prolongation& P : c.nested.prolongations) weights.push_back(weights_of(P));
    const std::vector<SparseRows> interpolations(weights.begin(), weights.end());
    BlackBox solver(given.A, interpolations, 1, {}, galerkin_products(given.A, weights)),
        usual(given.A, interpolations);
    expect_solution(solver, given, c.nested.finest());
    const auto a = solver.solve(given.b, given.lower, given.upper), b = usual.solve(given.b, given.lower, given.upper);
    EXPECT_EQ(a.summary.iterations, b.summary.iterations);
    EXPECT_LE((vector(a.x) - vector(b.x)).norm(), 1e-10 * (1e-300 + vector(b.x).norm()));
  }
  Random random(86);
  const auto problem = random_problem<2>(random, 300);
  const Given<2> given(problem);
  const Matrix P = pairs(300, 0.75);
  BlackBox solver(given.A, std::vector<SparseRows>{P}, 2, {}, galerkin_products(given.A, {for_components(P, 2)}));
  expect_solution(solver, given, problem);
}

// Coarse functions of zero rows alone have zero rows themselves.
TEST(BlackBox, TakesTheMatricesOfAnotherCodeAboveZeroRows) {
  constexpr int n = 64 * 64;
  Matrix A = laplacian(65);
  A.prune([](int row, int column, double) {
    const auto zero = [](int i) { return i % 8 == 1 || i / 2 == 33; };
    return !zero(row) && !zero(column);
  });
  const std::vector<double> b(n, 1), lower(n, -1), upper(n, 20);
  const auto usual = BlackBox(A).solve(b, lower, upper);
  for (const double weight : {1.0, 0.5}) {
    const std::vector<Matrix> weights{pairs(n / 2, weight), pairs(n, weight)};
    const std::vector<SparseRows> interpolations(weights.begin(), weights.end());
    const auto found = BlackBox(A, interpolations, 1, {}, galerkin_products(A, weights)).solve(b, lower, upper);
    EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
    EXPECT_EQ(found.x[1], 20);
    EXPECT_EQ(found.x[66], 20);
    EXPECT_LE((vector(found.x) - vector(usual.x)).norm(), 1e-6 * vector(usual.x).norm()) << weight;
  }
}

// The coarse function is the motion of a floating chain, its matrix exactly zero; a small load moves it far.
TEST(BlackBox, TakesACoarseMatrixThatIsZero) {
  constexpr int n = 16;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i + 1 < n; ++i)
    for (const auto& [row, column, value] : {std::tuple{i, i, 1}, {i + 1, i + 1, 1}, {i, i + 1, -1}, {i + 1, i, -1}})
      entries.emplace_back(row, column, value);
  Matrix A(n, n), constant(n, 1);
  A.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < n; ++i) constant.insert(i, 0) = 1;
  std::vector<double> b(n, -1e-4), lower(n, -1000);
  lower[3] = -7;
  const std::vector<SparseRows> interpolation{constant};
  const auto found = BlackBox(A, interpolation, 1, {}, galerkin_products(A, {constant})).solve(b, lower),
             usual = BlackBox(A, interpolation).solve(b, lower);
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_EQ(found.summary.iterations, usual.summary.iterations);
  EXPECT_EQ(found.x[3], -7);
  EXPECT_NEAR(found.multiplier[3], n * 1e-4, 1e-9);
}

TEST(BlackBox, OneSetUpServesSeveralLoadsAndBounds) {
  Random random(82);
  auto problem = random_problem<2>(random, 300);
  BlackBox solver(Given<2>(problem).A, 2);
  for (int step = 0; step < 5; ++step) {
    for (double& v : problem.b) v = random.between(-1, 1);
    for (double& v : problem.constraints.lower) v -= random.unit();
    expect_solution(solver, Given<2>(problem), problem);
  }
}

TEST(BlackBox, TakesCompressedRowsInAnyOrderAndOfEitherWidth) {
  // 2 -1 / -1 2 with the columns swapped and a diagonal entry in two parts.
  const std::vector<int> narrow{0, 3, 5}, column{1, 0, 0, 1, 0};
  const std::vector<std::int64_t> wide(narrow.begin(), narrow.end());
  const std::vector<double> value{-1, 0.5, 1.5, 2, -1}, b{1, 1};
  for (const SparseRows& A : {SparseRows(2, 2, narrow.data(), column.data(), value.data()),
                              SparseRows(2, 2, wide.data(), column.data(), value.data())}) {
    const auto x = BlackBox(A).solve(b).x;
    EXPECT_NEAR(x[0], 1, 1e-12);
    EXPECT_NEAR(x[1], 1, 1e-12);
  }
}

TEST(BlackBox, StartsWhereItIsTold) {
  const Matrix A = laplacian(40);
  const std::vector<double> b(static_cast<std::size_t>(A.rows()), 1);
  BlackBox solver(A);
  const auto cold = solver.solve(b);
  const auto warm = solver.solve(b, {}, {}, cold.x);
  EXPECT_LE(warm.summary.iterations, 2);
  EXPECT_GT(cold.summary.iterations, 4);
}

TEST(BlackBox, SolvesWithoutBoundsAndWithAllOfThemEqual) {
  const Matrix A = laplacian(30);
  Random random(83);
  std::vector<double> b(static_cast<std::size_t>(A.rows()));
  for (double& v : b) v = random.between(-1, 1);
  BlackBox solver(A);
  const auto free = solver.solve(b);
  const Eigen::VectorXd exact = Eigen::SimplicialLDLT<Matrix>(A).solve(vector(b));
  EXPECT_LE((vector(free.x) - exact).norm(), 1e-7 * exact.norm());
  const auto fixed = solver.solve(b, b, b);
  EXPECT_TRUE(fixed.summary.converged()) << fixed.summary.reason;
  EXPECT_EQ(fixed.x, b);
}

/// What is left of a matrix when the rows and columns of some unknowns are those of the identity, and b accounts for
/// their values.
struct Eliminated {
  Matrix A;
  std::vector<double> b;

  Eliminated(const Matrix& whole, std::vector<double> load, const std::vector<double>& lower,
             const std::vector<double>& upper)
      : A(whole) {
    const auto held = [&](Eigen::Index i) { return lower[i] == upper[i]; };
    Eigen::VectorXd values = Eigen::VectorXd::Zero(whole.rows());
    for (Eigen::Index i = 0; i < whole.rows(); ++i)
      if (held(i)) values[i] = lower[i];
    const Eigen::VectorXd rest = vector(load) - whole * values;
    A.prune([&](Eigen::Index i, Eigen::Index j, double) { return i == j || (!held(i) && !held(j)); });
    for (Eigen::Index i = 0; i < whole.rows(); ++i) {
      if (held(i)) A.coeffRef(i, i) = 1;
      load[i] = held(i) ? values[i] : rest[i];
    }
    b = std::move(load);
  }
};

void expect_like_eliminated(BlackBox& solver, const Matrix& A, int block, const std::vector<double>& b,
                            const std::vector<double>& lower, const std::vector<double>& upper) {
  SolverOptions options;
  options.tolerance = 1e-12;
  solver.set_tolerance(options.tolerance);
  const auto found = solver.solve(b, lower, upper);
  const Eliminated eliminated(A, b, lower, upper);
  const auto expected = BlackBox(eliminated.A, block, options).solve(eliminated.b, lower, upper);
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_NEAR(found.summary.iterations, expected.summary.iterations, 1);
  EXPECT_LE((vector(found.x) - vector(expected.x)).norm(), 1e-10 * vector(expected.x).norm());
  Eigen::VectorXd force = A * vector(found.x) - vector(b);
  for (std::size_t i = 0; i < found.active.size(); ++i)
    if (found.active[i] == 0) force[static_cast<Eigen::Index>(i)] = 0;
  EXPECT_LE((vector(found.multiplier) - force).norm(), 1e-12 * (A * vector(found.x)).norm());
  EXPECT_NEAR(found.summary.energy, 0.5 * vector(found.x).dot(A * vector(found.x)) - vector(b).dot(vector(found.x)),
              1e-10 * vector(found.x).dot(A * vector(found.x)));
}

// How a matrix alone gets prescribed values.
TEST(BlackBox, EqualBoundsTakeAsManyCyclesAsEliminatedRows) {
  constexpr int cells = 150, side = cells + 1;
  const Matrix A = neumann_laplacian(cells);
  const auto n = static_cast<std::size_t>(A.rows());
  std::vector<double> b(n, -1.0 / (cells * cells)), lower(n, -0.02), upper(n, infinity);
  for (int i = 0; i < side; ++i)
    for (const int at : {i, (side - 1) * side + i, i * side, i * side + side - 1})
      lower[at] = upper[at] = 0.01 * std::sin(0.1 * at);
  BlackBox solver(A);
  expect_like_eliminated(solver, A, 1, b, lower, upper);
  for (std::size_t i = 0; i < n; ++i)  // other values of the same unknowns, and another load
    if (lower[i] == upper[i]) lower[i] = upper[i] = 0.005;
  for (double& force : b) force *= 2;
  expect_like_eliminated(solver, A, 1, b, lower, upper);
  for (int i = 0; i < side; ++i) upper[i] = infinity;  // fewer, and others
  lower[n / 2] = upper[n / 2] = 0.1;
  expect_like_eliminated(solver, A, 1, b, lower, upper);
}

TEST(BlackBox, EqualBoundsOfSomeComponentsTakeAsManyCyclesAsEliminatedRows) {
  constexpr int cells = 60;
  const Mesh<2> mesh = cube<2>(0, 1, cells);
  const Matrix A = sparse(stiffness<2, 2>(mesh, Model<2>{}));
  const auto n = static_cast<std::size_t>(A.rows());
  std::vector<double> b(n, 0), lower(n, -infinity), upper(n, infinity);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const auto [x, y] = std::pair(mesh.points[p][0], mesh.points[p][1]);
    if (y == 1) lower[2 * p + 1] = upper[2 * p + 1] = 0;
    if (x == 0) lower[2 * p] = upper[2 * p] = 0;
    if (y == 0) lower[2 * p + 1] = -0.1 * x * x;
    b[2 * p + 1] = -1 / static_cast<double>(n);
  }
  BlackBox solver(A, 2);
  expect_like_eliminated(solver, A, 2, b, lower, upper);
}

TEST(BlackBox, FreesUnknownsWhoseBoundsAreNoLongerEqual) {
  const Matrix A = laplacian(60);
  const std::vector<double> b(static_cast<std::size_t>(A.rows()), -1e-3);
  std::vector<double> lower(b.size(), -0.3), upper(b.size(), infinity);
  for (std::size_t i = 0; i < b.size(); i += 7) upper[i] = lower[i];
  BlackBox solver(A);
  const auto fresh = BlackBox(A).solve(b), held = solver.solve(b, lower, upper), free = solver.solve(b);
  EXPECT_NE(held.x, free.x);
  EXPECT_EQ(fresh.x, free.x);
  EXPECT_EQ(fresh.summary.iterations, free.summary.iterations);
}

// The graph Laplacian has the constants in its kernel.
TEST(BlackBox, SolvesSemidefiniteProblemsThatTheBoundsMakeSolvable) {
  for (const int cells : {10, 60}) {
    const Matrix A = neumann_laplacian(cells);
    const auto n = static_cast<std::size_t>(A.rows());
    DiscreteProblem<1> problem = problem_of(A);
    Random random(84);
    for (double& v : problem.b) v = random.between(-1, 0.5);
    const std::vector<double> lower = waves(n);
    bound(problem, lower, std::vector<double>(n, infinity));
    expect_solution(problem);
  }
}

TEST(BlackBox, SolvesSemidefiniteProblemsWithAConsistentLoad) {
  const Matrix A = neumann_laplacian(60);
  Random random(85);
  Eigen::VectorXd v(A.rows());
  for (double& value : v) value = random.between(-1, 1);
  const Eigen::VectorXd b = A * v;
  const auto result = BlackBox(A).solve({b.data(), static_cast<std::size_t>(b.size())});
  EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
  EXPECT_LE((A * vector(result.x) - b).norm(), 1e-6 * b.norm());
}

TEST(BlackBox, SeesThatTheEnergyFallsForever) {
  for (const int cells : {10, 60}) {
    const Matrix A = neumann_laplacian(cells);
    const auto n = static_cast<std::size_t>(A.rows());
    const std::vector<double> b(n, 1.0);
    BlackBox solver(A);
    EXPECT_EQ(solver.solve(b).summary.outcome, Outcome::unbounded);
    EXPECT_EQ(solver.solve(b, waves(n)).summary.outcome, Outcome::unbounded);  // the bounds are on the wrong side
    EXPECT_TRUE(solver.solve(b, {}, waves(n)).summary.converged());
  }
}

// The coarse levels do not hold the direction without energy exactly: a scaled constant, a rotation.
TEST(BlackBox, SeesThatTheEnergyFallsForeverAlongAnyDirection) {
  for (const int cells : {10, 60}) {
    const Eigen::VectorXd s =
        vector(waves(static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1))).array() + 2;
    const Matrix A = s.asDiagonal() * neumann_laplacian(cells) * s.asDiagonal();
    const std::vector<double> b(static_cast<std::size_t>(A.rows()), 1.0);
    BlackBox solver(A);
    EXPECT_EQ(solver.solve(b).summary.outcome, Outcome::unbounded) << cells;
    EXPECT_EQ(solver.solve(b, waves(b.size())).summary.outcome, Outcome::unbounded) << cells;
    EXPECT_TRUE(solver.solve(b, {}, waves(b.size())).summary.converged()) << cells;
  }
  const Mesh<2> mesh = cube<2>(0, 1, 40);
  std::vector<double> torque, pull;
  for (const Point<2>& x : mesh.points) {
    torque.insert(torque.end(), {0.5 - x[1], x[0] - 0.5});
    pull.insert(pull.end(), {1, 0});
  }
  BlackBox solver(sparse(stiffness<2, 2>(mesh, Model<2>{})), 2);
  EXPECT_EQ(solver.solve(torque).summary.outcome, Outcome::unbounded);
  EXPECT_EQ(solver.solve(pull).summary.outcome, Outcome::unbounded);
}

TEST(BlackBox, StopsOnWhateverLevelTheMonitorSaysSoOnce) {
  const Membrane m;
  BlackBox solver(m.A);
  int calls = 0;
  solver.solve(m.b, m.lower, m.upper, {}, [&](const IterationRecord&) { return ++calls > 0; });
  ASSERT_GE(calls, 4);
  for (int stop = 1; stop <= calls; ++stop) {
    int call = 0;
    const auto result = solver.solve(m.b, m.lower, m.upper, {}, [&](const IterationRecord&) { return ++call != stop; });
    if (stop < calls) {
      EXPECT_EQ(result.summary.outcome, Outcome::interrupted) << "in call " << stop;
    }
    EXPECT_LE(call, stop + 1) << "one more, on the finest level";
  }
}

TEST(BlackBox, TakesWhateverIsAVectorForEigen) {
  const Membrane m;
  const auto n = static_cast<Eigen::Index>(m.n);
  BlackBox solver(m.A);
  const std::vector<double> expected = solver.solve(m.b, m.lower, m.upper).x;
  const Eigen::Map<const Eigen::VectorXd> b(m.b.data(), n), lower(m.lower.data(), n), upper(m.upper.data(), n);
  EXPECT_EQ(solver.solve(b, lower, upper).x, expected);
  Eigen::VectorXd all(3 * n);
  all << b, lower, upper;
  EXPECT_EQ(solver.solve(all.head(n), all.segment(n, n), all.tail(n)).x, expected);
  EXPECT_EQ(solver.solve(2 * b - b, (lower + lower) / 2, -(-upper)).x, expected);
  Eigen::MatrixXd beside(n, 3);
  beside << b, lower, upper;
  EXPECT_EQ(solver.solve(beside.col(0), beside.col(1), beside.col(2)).x, expected);
  const Eigen::MatrixXd turned = beside.transpose();
  EXPECT_EQ(solver.solve(turned.row(0), turned.row(1), turned.row(2)).x, expected) << "which do not lie together";
  Eigen::VectorXd strided(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) strided[2 * i] = b[i];
  const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>> every_second(strided.data(), n);
  BlackBox::Values kept = every_second, copy = kept;
  EXPECT_EQ(solver.solve(copy, Eigen::VectorXd(lower), Eigen::Ref<const Eigen::VectorXd>(upper)).x, expected);
  EXPECT_EQ(solver.solve(b.eval(), lower, upper, Eigen::VectorXd::Zero(n)).x,
            solver.solve(b, lower, upper, std::vector<double>(m.n)).x);
}

TEST(BlackBox, TakesWhateverIsASparseMatrixForEigen) {
  const Membrane m;
  const std::vector<double> expected = BlackBox(m.A).solve(m.b, m.lower, m.upper).x;
  const auto solve = [&](BlackBox solver) { return solver.solve(m.b, m.lower, m.upper).x; };
  const Eigen::Map<const Matrix> map(m.A.rows(), m.A.cols(), m.A.nonZeros(), m.A.outerIndexPtr(), m.A.innerIndexPtr(),
                                     m.A.valuePtr());
  EXPECT_EQ(solve(BlackBox(map)), expected);
  EXPECT_EQ(solve(BlackBox(2 * m.A - m.A)), expected);
  EXPECT_EQ(solve(BlackBox(m.A.transpose())), expected);
  EXPECT_EQ(solve(BlackBox(Eigen::SparseMatrix<double, Eigen::RowMajor, long>(m.A))), expected);
}

TEST(BlackBox, StopsWhenTheMonitorSaysSo) {
  const Matrix A = laplacian(30);
  const std::vector<double> b(static_cast<std::size_t>(A.rows()), 1.0);
  const auto result = BlackBox(A).solve(b, {}, {}, {}, [](const IterationRecord& r) { return r.iteration < 2; });
  EXPECT_EQ(result.summary.outcome, Outcome::interrupted);
}

TEST(BlackBox, TakesVectorsOfEigen) {
  const Matrix A = laplacian(30);
  const Eigen::VectorXd b = Eigen::VectorXd::Constant(A.rows(), -1e-3),
                        lower = Eigen::VectorXd::Constant(A.rows(), -0.1);
  const std::vector<double> load(b.begin(), b.end()), floor(lower.begin(), lower.end());
  BlackBox solver(A);
  EXPECT_EQ(solver.solve(b, lower).x, solver.solve(load, floor).x);
  EXPECT_EQ(solver.solve(b, floor).x, solver.solve({load.data(), load.size()}, lower).x);
}

// As in time steps of different lengths: mass and stiffness with other factors.
TEST(BlackBox, TakesAnotherMatrixOnTheSameInterpolations) {
  constexpr int cells = 80;
  const Matrix K = neumann_laplacian(cells);
  Matrix M(K.rows(), K.cols());
  M.setIdentity();
  const auto n = static_cast<std::size_t>(K.rows());
  std::vector<double> b(n, -1e-3), lower(n, -0.2), upper(n, infinity);
  for (std::size_t i = 0; i < n; i += 11) upper[i] = lower[i];
  BlackBox solver(Matrix(K + 1e-3 * M));
  for (const double mass : {1e-3, 5e-4, 2e-3}) {
    const Matrix A = K + mass * M;
    solver.set_matrix(A);
    const auto found = solver.solve(b, lower, upper), fresh = BlackBox(A).solve(b, lower, upper);
    EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
    EXPECT_LE(found.summary.iterations, fresh.summary.iterations + 2) << mass;
    EXPECT_LE((vector(found.x) - vector(fresh.x)).norm(), 1e-7 * vector(fresh.x).norm()) << mass;
    const Eigen::VectorXd force = A * vector(found.x) - vector(b);
    EXPECT_LE((vector(found.multiplier) - force).norm(), 1e-12 * A.norm() * vector(found.x).norm());
  }
}

}  // namespace
}  // namespace signorini::test
