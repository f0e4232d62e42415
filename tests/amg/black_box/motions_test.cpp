// Energies that fall for ever are told from those with a minimum, however many components, with any method and option.
#include "amg/black_box/motions.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "amg/black_box/block_rows.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using ::testing::HasSubstr;

/// Chains of vectors tied by springs. Each moves along `motion` without energy, but for those that a spring holds.
struct Chains {
  Matrix A;
  std::vector<double> b, lower, upper, motion;
  std::vector<Index> chain;  // of each vector
  std::vector<bool> held;    // each chain

  /// By the definition: whether the load does work along a chain's motion that no bound ends.
  bool unbounded() const {
    for (std::size_t c = 0; c < held.size(); ++c)
      for (const double sign : {1.0, -1.0})
        if (!held[c] && falls(static_cast<Index>(c), sign)) return true;
    return false;
  }

  bool falls(Index c, double sign) const {
    double work = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (chain[i] != c) continue;
      const double d = sign * motion[i];
      if ((d > 0 && upper[i] < infinity) || (d < 0 && lower[i] > -infinity)) return false;
      work += b[i] * d;
    }
    return work > 0;
  }
};

struct Kind {
  double lower, upper;  // chances of a bound
  double balanced, held;
  bool scaled;  // motions are not constant, but powers of two with random signs
};

// Loads are integers times the scales, so that work along motions is exact.
Chains random_chains(Random& random, int count, int longest, const Kind& kind) {
  Chains out;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index c = 0; c < count; ++c) {
    const auto first = static_cast<Index>(out.b.size());
    const int length = 2 + random.below(longest - 1);
    const bool balanced = random.chance(kind.balanced);
    int sum = 0;
    for (int k = 0; k < length; ++k) {
      const Index i = first + k;
      const double scale = kind.scaled ? std::ldexp(random.chance(0.5) ? 1 : -1, random.below(7) - 3) : 1;
      const int load = balanced && k == length - 1 ? -sum : random.below(19) - 9;
      sum += load;
      out.motion.push_back(1 / scale);
      out.b.push_back(scale * load);
      out.chain.push_back(c);
      out.lower.push_back(random.chance(kind.lower) ? random.between(-9, 1) : -infinity);
      out.upper.push_back(random.chance(kind.upper) ? random.between(1, 9) : infinity);
      if (k == 0) continue;
      const Index j = random.chance(0.7) ? i - 1 : first + random.below(k);
      const double weight = std::ldexp(1, random.below(9) - 4);
      const double other = 1 / out.motion[j];
      entries.emplace_back(i, i, weight * scale * scale);
      entries.emplace_back(j, j, weight * other * other);
      entries.emplace_back(i, j, -weight * scale * other);
      entries.emplace_back(j, i, -weight * scale * other);
    }
    out.held.push_back(random.chance(kind.held));
    if (out.held.back()) entries.emplace_back(first, first, 1 / (out.motion[first] * out.motion[first]));
  }
  const auto n = static_cast<Index>(out.b.size());
  out.A.resize(n, n);
  out.A.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// So many blocks [1 -1; -1 1].
Chains pairs(int count, std::vector<double> b) {
  Chains out;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < 2 * count; ++i) {
    entries.emplace_back(i, i, 1);
    entries.emplace_back(i, i ^ 1, -1);
    out.chain.push_back(i / 2);
  }
  out.A.resize(2 * count, 2 * count);
  out.A.setFromTriplets(entries.begin(), entries.end());
  const auto n = 2 * static_cast<std::size_t>(count);
  out.b = std::move(b);
  out.lower.assign(n, 0);
  out.upper.assign(n, infinity);
  out.motion.assign(n, 1);
  out.held.assign(static_cast<std::size_t>(count), false);
  return out;
}

Summary solve(const Chains& p, const SolverOptions& options = {}) {
  return BlackBox(p.A, 1, options).solve(p.b, p.lower, p.upper).summary;
}

std::vector<SolverOptions> variants() {
  std::vector<SolverOptions> out;
  for (const char* method : {"auto", "monotone", "tnnmg", "pgs", "pdas"}) out.emplace_back().method = method;
  out.emplace_back().coarse = "pgs";
  out.emplace_back().reassemble = false;
  return out;
}

std::string name(const SolverOptions& o) {
  return fmt::format("{}, coarse {}, reassemble {}", o.method, o.coarse, o.reassemble);
}

TEST(Motions, PairsThatNothingHoldsAreUnbounded) {
  for (const int count : {1, 2, 20, 21, 300, 3000})
    for (const SolverOptions& options : variants()) {
      const Chains p = pairs(count, std::vector<double>(2 * static_cast<std::size_t>(count), 1));
      const Summary s = solve(p, options);
      EXPECT_EQ(s.outcome, Outcome::unbounded) << count << " blocks, " << name(options) << ": " << s.reason;
      EXPECT_THAT(s.reason, HasSubstr("row 1"));
    }
}

TEST(Motions, TheOneOfManyComponentsThatFallsIsNamed) {
  std::vector<double> b(2000, -1);
  b[1234] = 2;  // the pair of rows 1235 and 1236
  for (const SolverOptions& options : variants()) {
    const Summary s = solve(pairs(1000, b), options);
    EXPECT_EQ(s.outcome, Outcome::unbounded) << name(options);
    EXPECT_THAT(s.reason, HasSubstr("row 1235"));
  }
}

// What is left of a load that nearly balances is no rounding.
TEST(Motions, LoadsBalanceToRoundingOrNotAtAll) {
  EXPECT_EQ(solve(pairs(1, {1, -0.999999999})).outcome, Outcome::unbounded);
  EXPECT_EQ(solve(pairs(1, {0.1, -0.1 + 1e-11})).outcome, Outcome::unbounded);
  EXPECT_TRUE(solve(pairs(1, {-1, 0.999999999})).converged());
  EXPECT_TRUE(solve(pairs(1, {0.1 + 0.2, -0.3})).converged());
}

/// @param to_the_end whether what has a solution is solved
void expect_right_answers(Random& random, int trials, int count, int longest, const SolverOptions& options,
                          bool to_the_end) {
  int falling = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const double bounded = std::array{0.02, 0.1, 0.5}[trial % 3];
    const int two_bits = trial % 4;
    const Kind kind{bounded * (trial % 2), two_bits >= 2 ? bounded : 0, trial % 5 == 0 ? 1 : 0.8, 0.2, trial % 7 > 2};
    const Chains p = random_chains(random, 1 + random.below(count), longest, kind);
    const Summary s = solve(p, options);
    SCOPED_TRACE(fmt::format("trial {}, {}: {}", trial, name(options), s.reason));
    EXPECT_EQ(s.outcome == Outcome::unbounded, p.unbounded());
    EXPECT_TRUE(p.unbounded() || s.converged() || !to_the_end);
    falling += p.unbounded();
  }
  EXPECT_GT(falling, trials / 10);
  EXPECT_LT(falling, trials - trials / 10);
}

TEST(Motions, RandomChains) {
  Random random(91);
  expect_right_answers(random, 300, 8, 40, {}, true);
}

TEST(Motions, RandomChainsWithEveryMethodAndOption) {
  Random random(92);
  for (SolverOptions options : variants()) {
    options.max_iterations = 20;  // what is told before the first one is of interest
    expect_right_answers(random, 60, 10, 40, options, false);
  }
}

TEST(Motions, LongChains) {
  Random random(93);
  for (const bool scaled : {false, true})
    for (const SolverOptions& options : variants()) {
      Chains p = random_chains(random, 2, 4000, {0, 0, 1, 0, scaled});
      p.b[5] += 1 / p.motion[5];
      EXPECT_EQ(solve(p, options).outcome, Outcome::unbounded) << name(options);
    }
}

// Some ten rigid motions of bodies in the plane, two of which are tied to rollers: cones that bounds of several motions
// make.
TEST(Motions, ElasticBodies) {
  const Mesh<2> mesh = cube<2>(0, 1, 6);
  const Matrix one = sparse(stiffness<2, 2>(mesh, Model<2>{}));
  const int bodies = 4;
  const Matrix A = copies(bodies, one);
  const auto n = static_cast<std::size_t>(A.rows()), each = static_cast<std::size_t>(one.rows());
  BlackBox solver(A, 2);
  std::vector<double> b(n), lower(n, -infinity), upper(n, infinity);
  for (std::size_t body = 0; body < bodies; ++body)
    for (Index p = 0; p < mesh.vertices(); ++p) {
      const std::size_t i = body * each + 2 * static_cast<std::size_t>(p);
      b[i + 1] = -1;
      if (mesh.points[p][1] == 0) lower[i + 1] = 0;
    }
  EXPECT_TRUE(solver.solve(b, lower, upper).summary.converged());
  for (const auto& [x, y] : {std::pair(1.0, 0.0), {0.0, 1e3}, {1e-7, 0.0}}) {
    std::vector<double> pushed = b;
    pushed[2 * each] += x;
    pushed[2 * each + 1] += y;
    const Summary s = solver.solve(pushed, lower, upper).summary;
    EXPECT_EQ(s.outcome, Outcome::unbounded) << x << ", " << y << ": " << s.reason;
  }
  std::vector<double> corner = b;  // pressed on beyond its edge: it tips over
  corner[3 * each + 1] -= 1e3;
  EXPECT_TRUE(solver.solve(corner, lower, upper).summary.converged());
  lower[3 * each + 1] = -infinity;
  EXPECT_EQ(solver.solve(corner, lower, upper).summary.outcome, Outcome::unbounded);
}

/// A plane truss of m x h squares with both diagonals, of stiffnesses such that all entries are whole numbers.
Matrix truss(Index m, Index h) {
  const auto joint = [m](Index x, Index y) { return y * (m + 1) + x; };
  std::vector<Eigen::Triplet<double>> entries;
  for (Index x = 0; x <= m; ++x)
    for (Index y = 0; y <= h; ++y)
      for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {-1, 1}}) {
        if (x + dx < 0 || x + dx > m || y + dy > h) continue;
        const Index at[4] = {2 * joint(x, y), 2 * joint(x, y) + 1, 2 * joint(x + dx, y + dy),
                             2 * joint(x + dx, y + dy) + 1};
        const double along[4] = {-1.0 * dx, -1.0 * dy, 1.0 * dx, 1.0 * dy};
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            if (along[i] * along[j] != 0) entries.emplace_back(at[i], at[j], along[i] * along[j]);
      }
  const Index n = 2 * (m + 1) * (h + 1);
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// Of its weight next to nothing is left where the floor has taken its part, and that little decides: they slide away.
TEST(Motions, TrussesThatHardlySlide) {
  for (const auto& [m, h] : {std::pair(1, 1), {2, 1}, {3, 3}, {6, 3}, {12, 12}, {20, 20}}) {
    const Matrix A = truss(m, h);
    std::vector<double> weight(static_cast<std::size_t>(A.rows())), floor(weight.size(), -infinity);
    for (std::size_t k = 1; k < weight.size(); k += 2) weight[k] = -1;
    for (int x = 0; x <= m; ++x) floor[2 * static_cast<std::size_t>(x) + 1] = 0;
    EXPECT_TRUE(BlackBox(A, 1).solve(weight, floor).summary.converged()) << m;
    for (const int power : {0, 10, 19, 24, 27, 30, 34}) {
      std::vector<double> pushed = weight;
      for (std::size_t k = 0; k < weight.size(); k += 2) pushed[k] = std::ldexp(1.0, -power);
      for (const char* method : {"auto", "tnnmg", "pdas"}) {
        SolverOptions options;
        options.method = method;
        const Summary summary = BlackBox(A, 1, options).solve(pushed, floor).summary;
        EXPECT_EQ(summary.outcome, Outcome::unbounded)
            << m << ", " << power << ", " << method << ": " << summary.reason;
        EXPECT_THAT(summary.reason, HasSubstr("row")) << m << ", " << power << ", " << method;
      }
    }
  }
}

/// D A D: its motions are no constants, and its diagonal does not dominate.
Matrix scaled_by_waves(const Matrix& A) {
  const Eigen::VectorXd s = vector(waves(static_cast<std::size_t>(A.rows()))).array() + 2;
  return s.asDiagonal() * A * s.asDiagonal();
}

/// A body on a floor, and a load that pushes it sideways as well.
template <int D>
struct PushedAside {
  Matrix A;
  std::vector<double> load, floor;

  explicit PushedAside(int cells) {
    const Mesh<D> mesh = cube<D>(0, 1, cells);
    A = sparse(stiffness<D, D>(mesh, Model<D>{}));
    for (const Point<D>& x : mesh.points)
      for (int k = 0; k < D; ++k) {
        load.push_back(k + 1 < D ? 0.1 : -1);
        floor.push_back(k + 1 == D && x[k] == 0 ? 0.0 : -infinity);
      }
  }
};

TEST(Motions, PlaneBodiesOfManyVectorsAreFactorised) {
  EXPECT_TRUE(Motions<1>(block_matrix<1>(SparseRows(scaled_by_waves(neumann_laplacian(64))))).complete());
  const PushedAside<2> body(64);
  EXPECT_TRUE(Motions<2>(block_matrix<2>(SparseRows(body.A))).complete());
  const Summary summary = BlackBox(body.A, 2).solve(body.load, body.floor).summary;
  EXPECT_EQ(summary.outcome, Outcome::unbounded);
  EXPECT_EQ(summary.iterations, 0);
}

// Too large to be factorised: iterates that run away tell.
TEST(Motions, LargeBodiesWithAnyMethod) {
  const Matrix scalar = scaled_by_waves(sparse(stiffness<3, 1>(cube<3>(0, 1, 17), Model<1>{})));
  const std::vector<double> up(static_cast<std::size_t>(scalar.rows()), 1), lower(up.size(), 0);
  const PushedAside<2> body(105);
  EXPECT_FALSE(Motions<1>(block_matrix<1>(SparseRows(scalar))).complete());
  EXPECT_FALSE(Motions<2>(block_matrix<2>(SparseRows(body.A))).complete());
  for (const char* method : {"monotone", "tnnmg", "pgs", "pdas"}) {
    SolverOptions options;
    options.method = method;
    options.max_iterations = 50;
    const bool levels = options.method == "monotone" || options.method == "tnnmg";
    if (nightly() || options.method == "monotone" || !levels) {
      EXPECT_EQ(BlackBox(scalar, 1, options).solve(up, lower).summary.outcome, Outcome::unbounded) << name(options);
    }
    if (nightly() || levels) {
      EXPECT_EQ(BlackBox(body.A, 2, options).solve(body.load, body.floor).summary.outcome, Outcome::unbounded)
          << name(options);
    }
  }
}

// A (4, 1/8, 1/4) is zero, and the load does 4e-6 work along it.
TEST(Motions, StiffSpringsDoNotHideThem) {
  Matrix A(3, 3);
  A.insert(0, 0) = 32;
  A.insert(1, 1) = 32770;
  A.insert(2, 2) = 0.5;
  A.insert(0, 1) = A.insert(1, 0) = -1024;
  A.insert(1, 2) = A.insert(2, 1) = -1;
  const Eigen::Vector3d motion(4, 0.125, 0.25);
  ASSERT_EQ((A * motion).norm(), 0);
  const std::vector<double> lower{-infinity, 0, -infinity};
  for (const double more : {1e-6, 0.0, -1e-6}) {
    const std::vector<double> load{4 + more, -1, -63.5};
    const Outcome outcome = BlackBox(A, 1).solve(load, lower).summary.outcome;
    if (more > 0)
      EXPECT_EQ(outcome, Outcome::unbounded);
    else
      EXPECT_EQ(outcome, Outcome::converged) << more;
  }
}

// Trees of springs with stiffnesses over six decades, in random units: the unknown of the last pivot may hardly move.
TEST(Motions, ThoseThatHardlyMoveSomeUnknownsAreFound) {
  Random random(94);
  for (int trial = 0; trial < 1500; ++trial) {
    const auto n = static_cast<Index>(2 + random.below(60));
    std::vector<double> unit, b;
    std::vector<Eigen::Triplet<double>> entries;
    int sum = 0;
    for (Index i = 0; i < n; ++i) {
      unit.push_back(std::ldexp(random.chance(0.5) ? 1 : -1, random.below(7) - 3));
      const int load = i + 1 < n || sum != 0 ? random.below(19) - 9 : 1;
      b.push_back(unit[i] * load);
      sum += load;
      if (i == 0) continue;
      const Index j = random.chance(0.5) ? i - 1 : random.below(i);
      const double stiffness = std::pow(10, random.between(-3, 3));
      entries.emplace_back(i, i, stiffness * unit[i] * unit[i]);
      entries.emplace_back(j, j, stiffness * unit[j] * unit[j]);
      entries.emplace_back(i, j, -stiffness * unit[i] * unit[j]);
      entries.emplace_back(j, i, -stiffness * unit[i] * unit[j]);
    }
    if (sum == 0) continue;
    Matrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    EXPECT_TRUE(Motions<1>(block_matrix<1>(SparseRows(A))).fall(b, {}).row) << trial;
  }
}

TEST(Motions, NearlySingularIsNotSingular) {
  for (const double spring : {1e-9, 1e-12}) {
    Matrix A = neumann_laplacian(6);
    A.coeffRef(0, 0) += spring;
    const auto dominated = Motions<1>(block_matrix<1>(SparseRows(A)));
    const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(A.rows(), 1, 3);
    const Matrix scaled = s.asDiagonal() * A * s.asDiagonal();
    const auto factorised = Motions<1>(block_matrix<1>(SparseRows(scaled)));
    const std::vector<double> b(static_cast<std::size_t>(A.rows()), 1);
    EXPECT_FALSE(dominated.fall(b, {}).row) << spring;
    EXPECT_FALSE(factorised.fall(b, {}).row) << spring;
  }
}

}  // namespace
}  // namespace signorini::test
