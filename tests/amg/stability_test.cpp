// Matrices that are hard on a solver: all are solved to the tolerance, and the energy never grows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

struct Problem {
  Matrix A;
  std::vector<double> b, lower, upper;
};

/// max |x - Proj(x - D^-1 (Ax - b))| with the diagonal D of A.
double natural_residual(const Problem& p, const Eigen::VectorXd& x) {
  const Eigen::VectorXd step = (vector(p.b) - p.A * x).cwiseQuotient(p.A.diagonal());
  return (x - (x + step).cwiseMax(vector(p.lower)).cwiseMin(vector(p.upper))).cwiseAbs().maxCoeff();
}

/// With energies that fall, but for methods whose iterates leave the bounds.
Summary expect_solved(const Problem& p, int block = 1) {
  const BlackBox::Result result = BlackBox(p.A, block).solve(p.b, p.lower, p.upper);
  EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
  const Eigen::VectorXd x = vector(result.x);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(x.size()).cwiseMax(vector(p.lower)).cwiseMin(vector(p.upper));
  const double rounding = 1e-12 * x.cwiseAbs().maxCoeff();
  EXPECT_LE(natural_residual(p, x),
            3e-8 * natural_residual(p, zero) + rounding);  // for blocks D is their diagonal here
  const Eigen::VectorXd size = x.cwiseAbs();
  const double terms = size.dot(p.A.cwiseAbs() * size) + vector(p.b).cwiseAbs().dot(size);
  double energy = infinity;
  for (const IterationRecord& cycle : result.summary.history) {
    if (result.summary.stages[cycle.stage].linear_solves > 0) break;
    EXPECT_LE(cycle.energy, energy + 1e-13 * terms) << cycle.iteration;
    energy = cycle.energy;
  }
  return result.summary;
}

/// The graph Laplacian of a grid and of random further edges, the weights between 10^-decades and 10^decades, and a
/// diagonal shift of parts of the rows.
Matrix random_graph(Random& random, int nodes, double decades, double shift) {
  const Index n = nodes * nodes;
  std::vector<Eigen::Triplet<double>> entries;
  const auto edge = [&](Index p, Index q) {
    if (p == q) return;
    const double weight = std::pow(10, random.between(-decades, decades));
    for (const auto& [i, j] : {std::pair(p, q), {q, p}}) {
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(i, i, weight);
    }
  };
  for (Index p = 0; p < n; ++p) {
    if (p % nodes != nodes - 1) edge(p, p + 1);
    if (p + nodes < n) edge(p, p + nodes);
    if (random.chance(0.1)) edge(p, random.below(n));
    if (shift > 0 && random.chance(0.3)) entries.emplace_back(p, p, shift * random.unit());
  }
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Problem random_box(Random& random, const Matrix& A) {
  const auto n = static_cast<std::size_t>(A.rows());
  Problem p{A, std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    p.b[i] = random.between(-1, 1) * p.A.coeff(static_cast<Index>(i), static_cast<Index>(i));
    std::tie(p.lower[i], p.upper[i]) = random_interval(random, 0, 1);
  }
  return p;
}

TEST(Stability, RandomMMatrices) {
  Random random(71);
  for (const double decades : {0.0, 1.5, 3.0})
    for (int trial = 0; trial < 3; ++trial) {
      SCOPED_TRACE(fmt::format("weights over {} decades, trial {}", 2 * decades, trial));
      expect_solved(random_box(random, random_graph(random, 50, decades, 1)));
    }
}

TEST(Stability, GraphLaplaciansWithWeightsOverEightDecades) {
  Random random(72);
  for (int trial = 0; trial < 5; ++trial) expect_solved(random_box(random, random_graph(random, 50, 4, 0)));
}

// Clusters of stiff edges, which meet the bounds one after the other: few cycles see more than one of them. Each vector
// is tied to some before it.
TEST(Stability, RandomTreesWithWeightsOverEightDecades) {
  Random random(77);
  const Index n = 5000;
  std::vector<Eigen::Triplet<double>> entries;
  const auto tie = [&](Index p) {
    const Index q = random.below(p);
    const double weight = std::pow(10, random.between(0, 8));
    for (const auto& [i, j] : {std::pair(p, q), {q, p}}) {
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(i, i, weight);
    }
  };
  for (Index p = 1; p < n; ++p) {
    tie(p);
    if (random.chance(0.5)) tie(p);
  }
  Problem p{Matrix(n, n), {}, {}, std::vector<double>(static_cast<std::size_t>(n), infinity)};
  p.A.setFromTriplets(entries.begin(), entries.end());
  for (Index i = 0; i < n; ++i) {
    p.b.push_back(random.between(-0.6, 0.4));
    p.lower.push_back(random.between(-1, -0.5));
  }
  const Summary summary = expect_solved(p);
  EXPECT_LE(summary.iterations, 60);
  EXPECT_EQ(summary.stages.back().method, "pdas");
  EXPECT_EQ(summary.stages.back().linear, "amg_cg");
  EXPECT_LE(summary.stages.back().linear_solves, 30);
}

template <int D>
Mesh<D> mapped(Mesh<D> mesh, const std::function<Point<D>(Point<D>)>& map) {
  for (Point<D>& x : mesh.points) x = map(x);
  return mesh;
}

Matrix positive_part(const Matrix& A) {
  Matrix out = A;
  out.prune([](Index i, Index j, double value) { return i != j && value > 0; });
  return out;
}

template <int D, int B>
Problem problem_on(const Mesh<D>& mesh, const Model<B>& model) {
  const Given<B> given(discretize<D, B>(mesh, model).problem);
  return {given.A, given.b, given.lower, given.upper};
}

Model<1> pressed_membrane() {
  return membrane(-1, [](const double* x) { return -0.01 - 0.002 * std::sin(7 * x[0]); }, {});
}

TEST(Stability, PositiveOffDiagonalsOfObtuseTriangles) {
  for (const double shear : {0.5, 1.0, 2.0, 4.0}) {
    const auto mesh = mapped<2>(cube<2>(0, 1, 48), [=](Point<2> x) -> Point<2> { return {x[0] + shear * x[1], x[1]}; });
    const Problem problem = problem_on<2, 1>(mesh, pressed_membrane());
    EXPECT_GT(positive_part(problem.A).nonZeros(), 0);
    SCOPED_TRACE(shear);
    expect_solved(problem);
  }
}

TEST(Stability, NeedleElements) {
  for (const double width : {1e-1, 1e-2, 1e-3}) {
    SCOPED_TRACE(width);
    const auto thin = mapped<2>(cube<2>(0, 1, 48), [=](Point<2> x) -> Point<2> { return {width * x[0], x[1]}; });
    Model<1> model = pressed_membrane();
    model.fixes = {{on("top"), {Field(0)}}, {on("bottom"), {Field(0)}}};
    expect_solved(problem_on<2, 1>(thin, model));
  }
}

// Bilinear elements so many times as long as high, on the inner nodes of a square.
Matrix stretched_elements(int nodes, double times) {
  const auto stiffness = [](int d) { return d == 0 ? 2.0 : -1.0; };
  const auto mass = [](int d) { return d == 0 ? 4.0 / 6 : 1.0 / 6; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes * nodes; ++i)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const int x = i % nodes + dx, y = i / nodes + dy;
        if (std::min(x, y) < 0 || std::max(x, y) >= nodes) continue;
        entries.emplace_back(i, y * nodes + x, stiffness(dx) * mass(dy) / times + times * mass(dx) * stiffness(dy));
      }
  Matrix A(nodes * nodes, nodes * nodes);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(Stability, StretchedBilinearElements) {
  constexpr int nodes = 99;
  for (const double times : {3, 10, 30, 100}) {
    SCOPED_TRACE(times);
    const Matrix A = stretched_elements(nodes, times);
    const auto n = static_cast<std::size_t>(A.rows());
    const double load = 1.0 / (nodes * nodes);
    const Problem p{A, std::vector<double>(n, -load), std::vector<double>(n, -0.06 / times),
                    std::vector<double>(n, infinity)};
    EXPECT_LE(expect_solved(p).iterations, 16);
  }
}

TEST(Stability, NeedleElementsOfAnElasticBody) {
  for (const double width : {1e-1, 1e-2}) {
    SCOPED_TRACE(width);
    const auto thin = mapped<2>(cube<2>(0, 1, 24), [=](Point<2> x) -> Point<2> { return {width * x[0], x[1]}; });
    const auto c = problem_on<2, 2>(thin, pressed_block<2>(plane<2>({0, 0}, {0, 1}), 0.05));
    expect_solved(c, 2);
  }
}

// Two bodies that nothing but the obstacle holds, one of which it does not even touch at the start.
TEST(Stability, FloatingBodies) {
  Random random(73);
  const Matrix one = random_graph(random, 30, 0, 0);
  const Index n = static_cast<Index>(one.rows());
  const auto size = 2 * static_cast<std::size_t>(n);
  Problem p{copies(2, one), std::vector<double>(size, -1), std::vector<double>(size, -infinity),
            std::vector<double>(size, infinity)};
  for (std::size_t i = 0; i < size; ++i)
    if (i % 7 == 0) p.lower[i] = i < size / 2 ? 0 : -5;
  expect_solved(p);
}

// More bodies than a coarsest level has vectors, each above one bound that no coarse function knows.
TEST(Stability, ManyFloatingBodies) {
  Random random(75);
  const std::size_t bodies = 50, size = 36 * bodies;
  Problem p{copies(bodies, neumann_laplacian(5)), std::vector<double>(size, -1), std::vector<double>(size, -infinity),
            std::vector<double>(size, infinity)};
  for (std::size_t body = 0; body < bodies; ++body) p.lower[36 * body] = random.between(-2, 2);
  EXPECT_LE(expect_solved(p).iterations, 15);
}

/// Chains of vectors that springs tie together, with weights over four decades and loads that balance on each chain.
/// One in fifteen vectors has a bound: on many chains there is none.
/// @param scaled motions are not constant, but powers of two with random signs
Problem balanced_chains(Random& random, Index n, bool scaled) {
  Problem p;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> scale(static_cast<std::size_t>(n), 1), load(scale.size(), 0);
  for (double& s : scale)
    if (scaled) s = std::ldexp(random.chance(0.5) ? 1 : -1, static_cast<int>(random.below(7)) - 3);
  Index first = 0;  // of its chain
  for (Index i = 0; i < n; ++i) {
    if (i > first + 1 && i + 1 < n && random.chance(0.08)) first = i;
    if (i == first) continue;
    load[i] = random.below(19) - 9;
    load[first] -= load[i];
    const Index other = random.chance(0.7) ? i - 1 : first + random.below(i - first);
    const double weight = std::pow(10, random.between(-2, 2));
    for (const auto& [r, c] : {std::pair(i, other), {other, i}}) {
      entries.emplace_back(r, c, -weight * scale[r] * scale[c]);
      entries.emplace_back(r, r, weight * scale[r] * scale[r]);
    }
  }
  p.A.resize(n, n);
  p.A.setFromTriplets(entries.begin(), entries.end());
  for (Index i = 0; i < n; ++i) {
    p.b.push_back(scale[i] * load[i]);
    p.lower.push_back(random.chance(0.07) ? random.between(-9, 1) : -infinity);
    p.upper.push_back(random.chance(0.07) ? random.between(1, 9) : infinity);
  }
  return p;
}

// What rounding leaves of the forces must not move chains that nothing holds.
TEST(Stability, BalancedChainsSomeWithoutAnyBound) {
  Random random(79);
  for (const bool scaled : {false, true})
    for (int trial = 0; trial < 4; ++trial) {
      SCOPED_TRACE(fmt::format("scaled {}, trial {}", scaled, trial));
      expect_solved(balanced_chains(random, 3000, scaled));
    }
}

// Iterates run away along the motion until the residual is rounding of them, which must not count as solved.
TEST(Stability, WhatNothingHoldsIsNeverCalledSolved) {
  Random random(78);
  for (int trial = 0; trial < 30; ++trial) {
    Matrix A = random_graph(random, 18 + trial % 24, 2, 0);
    const auto n = static_cast<std::size_t>(A.rows());
    std::vector<double> sign(n), b(n);
    Index work = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Index load = random.below(7) - 3;
      sign[i] = random.chance(0.5) ? 1 : -1;
      b[i] = sign[i] * load;
      work += load;
    }
    if (work == 0) continue;
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      for (Matrix::InnerIterator entry(A, k); entry; ++entry) entry.valueRef() *= sign[entry.row()] * sign[entry.col()];
    const Summary summary = BlackBox(A, 1).solve(b).summary;
    EXPECT_FALSE(summary.converged()) << trial << ": " << summary.reason;
  }
}

Matrix normal_equations(Index equations, Index unknowns, const std::vector<Eigen::Triplet<double>>& entries) {
  Matrix G(equations, unknowns);
  G.setFromTriplets(entries.begin(), entries.end());
  return G.transpose() * G;
}

// The normal equations of fewer equations than unknowns: a kernel of many dimensions, and functions of coarser levels
// in it.
TEST(Stability, UnderdeterminedLeastSquares) {
  Random random(76);
  for (int trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE(trial);
    const Index n = 600;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(2 * n);
    for (Index i = 0; i < n; ++i) entries.emplace_back(i % (n / 2), i, random.between(-2, 2));
    for (Index k = 0; k < 3 * n / 4; ++k)
      entries.emplace_back(n / 2 + random.below(n / 4), random.below(n), random.between(0, 1));
    Problem p{normal_equations(3 * n / 4, n, entries),
              {},
              std::vector<double>(n, -infinity),
              std::vector<double>(n, infinity)};
    const Eigen::VectorXd b = p.A * vector(waves(n));
    p.b = {b.begin(), b.end()};
    expect_solved(p);
  }
}

// The same in integers, with bounds and a solution in integers: the energy is bounded, and a coarse level may take what
// rounding leaves of a motion for one that falls for ever.
TEST(Stability, LeastSquaresInIntegersAreBounded) {
  for (int seed = 0; seed < nightly(60, 20); ++seed) {
    SCOPED_TRACE(seed);
    Random random(1000 + seed);
    const Index n = 400 + random.below(500), equations = n / 10 + random.below(n / 2), terms = 2 + random.below(4);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < equations; ++i) {
      const Index count = random.chance(0.5) ? terms : 2 + random.below(4);
      for (Index k = 0; k < count; ++k) entries.emplace_back(i, random.below(n), random.below(7) - 3);
    }
    Matrix A = normal_equations(equations, n, entries);
    A.prune(0.0);
    Eigen::VectorXd x(n), force = Eigen::VectorXd::Zero(n);
    std::vector<double> lower(n, -infinity), upper(n, infinity);
    const double part = random.between(0.2, 0.5);
    for (Index i = 0; i < n; ++i) {
      x[i] = random.below(9) - 4;
      if (!random.chance(part)) continue;
      const bool below = random.chance(0.5), touches = random.chance(0.5);
      (below ? lower : upper)[i] = x[i] + (touches ? 0 : (below ? -1 : 1) * (1 + random.below(3)));
      if (touches && random.chance(0.8)) force[i] = (below ? 1 : -1) * (1 + random.below(3));
    }
    const Eigen::VectorXd b = A * x - force;
    const BlackBox::Result result = BlackBox(A, 1).solve(b, lower, upper);
    EXPECT_NE(result.summary.outcome, Outcome::unbounded) << result.summary.reason;
    const bool runs_along_the_kernel = vector(result.x).cwiseAbs().maxCoeff() > 1e3;  // which hides d'Ad in doubles
    if (!result.summary.converged() || runs_along_the_kernel) continue;
    const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(result.x.data(), n) - x;
    EXPECT_LE(d.dot(A * d), 1e-10 * x.dot(A * x));
  }
}

// A third of the second differences along a line: semidefinite, in a box that holds what they do not.
TEST(Stability, SecondDifferencesInABox) {
  Random random(77);
  const Index n = 800;
  std::vector<Eigen::Triplet<double>> entries;
  Index equations = 0;
  for (Index i = 0; i + 2 < n; i += 1 + random.below(3), ++equations)
    for (const Index k : {0, 1, 2}) entries.emplace_back(equations, i + k, k == 1 ? -2 : 1);
  for (const Index end : {n - 2, n - 1}) entries.emplace_back(equations++, end, 0.1);
  Problem p{normal_equations(equations, n, entries), std::vector<double>(n), std::vector<double>(n, -1),
            std::vector<double>(n, 1)};
  for (double& force : p.b) force = random.between(-1, 1);
  expect_solved(p);
}

// Sums of a few random unknowns, a third as many as there are unknowns: active sets cycle.
TEST(Stability, LeastSquaresInABox) {
  Random random(80);
  for (const Index n : {300, 300, 1200, 1200}) {
    SCOPED_TRACE(n);
    const auto size = static_cast<std::size_t>(n);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index k = 0; k < n / 3; ++k)
      for (int term = 0; term < 4; ++term) entries.emplace_back(k, random.below(n), random.between(-2, 2));
    Problem p{normal_equations(n / 3, n, entries), std::vector<double>(size, 0), std::vector<double>(size, -10),
              std::vector<double>(size, 10)};
    for (const auto& entry : entries) p.b[entry.col()] += entry.value() * (entry.row() % 61 - 30);
    for (Index i = 0; i < n; ++i)
      if (p.A.coeff(i, i) == 0) p.A.coeffRef(i, i) = 1;
    expect_solved(p);
  }
}

TEST(Stability, FloatingElasticBlocks) {
  expect_solved(problem_on<2, 2>(cube<2>(0, 1, 24), resting_block<2>({0.1, -1}, {"left"})), 2);
  expect_solved(problem_on<3, 3>(cube<3>(0, 1, 8), resting_block<3>({0.1, 0.1, -1}, {"left", "front"})), 3);
}

// The solution touches both bounds, or one, nearly everywhere without any force.
TEST(Stability, BiactiveSets) {
  const Matrix A = laplacian(60);
  const auto n = static_cast<std::size_t>(A.rows());
  Eigen::VectorXd solution = vector(waves(n));
  const Eigen::VectorXd b = A * solution;
  Problem p{A, {b.begin(), b.end()}, {solution.begin(), solution.end()}, {solution.begin(), solution.end()}};
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 3 != 0) p.upper[i] = infinity;
    if (i % 5 == 0) p.lower[i] = -infinity;
  }
  expect_solved(p);
}

TEST(Stability, AllBoundsEqualAndNoneAtAll) {
  Random random(74);
  Problem p = random_box(random, random_graph(random, 50, 2, 1));
  p.lower = p.upper = waves(p.b.size());
  expect_solved(p);
  p.lower.assign(p.b.size(), -infinity);
  p.upper.assign(p.b.size(), infinity);
  expect_solved(p);
}

}  // namespace
}  // namespace signorini::test
