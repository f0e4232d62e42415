// Solutions of ill-conditioned chains and trees of springs between bounds, against a solver in extended precision that
// knows the trees: no error is larger than what is claimed, and nothing bounded is called unbounded.
#include "amg/black_box/refinement.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

struct Kind {
  int decades;             // of the stiffness, binary
  bool powers;             // of two: sums of two of them are exact
  bool scaled, branching;  // D A D with powers of two and random signs
  bool balanced;           // loads sum to zero, and what anchors the tree is as weak as springs may be
  double bounded;          // chance of a bound, below and above
};

/// Each vertex hangs on an earlier one, the first one on the ground.
struct Tree {
  std::vector<int> parent;
  std::vector<double> diagonal, coupling, b, lower, upper;  // coupling: to the parent

  Tree(Random& random, int n, const Kind& kind)
      : parent(static_cast<std::size_t>(n), -1), diagonal(parent.size()), coupling(parent.size()) {
    const auto stiffness = [&] {
      return kind.powers ? std::ldexp(1, random.below(kind.decades + 1)) : std::exp2(random.between(0, kind.decades));
    };
    std::vector<double> scale(parent.size(), 1);
    for (double& s : scale)
      if (kind.scaled) s = std::ldexp(random.chance(0.5) ? 1 : -1, random.below(13) - 6);
    diagonal[0] = kind.balanced ? 1 : stiffness();
    for (int i = 1; i < n; ++i) {
      parent[i] = kind.branching && random.chance(0.3) ? random.below(i) : i - 1;
      const double k = stiffness();
      diagonal[i] += k;
      diagonal[parent[i]] += k;
      coupling[i] = -k * scale[i] * scale[parent[i]];
    }
    int sum = 0;
    for (int i = 0; i < n; ++i) {
      diagonal[i] *= scale[i] * scale[i];
      const int load = i == n - 1 ? -sum : random.below(19) - 9;
      sum += load;
      b.push_back(kind.balanced ? load * scale[i] : random.between(-1, 1));
      lower.push_back(random.chance(kind.bounded) ? -std::ldexp(1, -random.below(kind.decades + 1)) : -infinity);
      upper.push_back(random.chance(kind.bounded) ? std::ldexp(1, -random.below(kind.decades + 1)) : infinity);
    }
  }

  Matrix matrix() const {
    const auto n = static_cast<Index>(b.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < n; ++i) {
      entries.emplace_back(i, i, diagonal[i]);
      if (i == 0) continue;
      entries.emplace_back(i, parent[i], coupling[i]);
      entries.emplace_back(parent[i], i, coupling[i]);
    }
    Matrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }
};

/// Numbers with twice the digits of a double where the compiler has them.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
using Wide = long double;
#endif

/// By active sets, each of them by elimination from the leaves to the root.
class Exact {
 public:
  explicit Exact(const Tree& tree) : t_(tree), x_(tree.b.size()), active_(tree.b.size(), 0) {}

  /// @param near a vector whose active set to begin with
  bool find(const std::vector<double>& near) {
    for (std::size_t i = 0; i < near.size(); ++i)
      active_[i] = near[i] <= t_.lower[i] ? -1 : near[i] >= t_.upper[i] ? 1 : 0;
    for (int set = 0; set < 100; ++set) {
      eliminate();
      if (!change()) return true;
    }
    return false;
  }

  /// ||x - x*||_A / ||x*||_A
  double error(const std::vector<double>& x) const {
    std::vector<Wide> d(x_);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] -= x[i];
    return std::sqrt(static_cast<double>(energy(d) / energy(x_)));
  }

 private:
  void eliminate() {
    const auto n = x_.size();
    std::vector<Wide> pivot(t_.diagonal.begin(), t_.diagonal.end()), rest(t_.b.begin(), t_.b.end());
    for (std::size_t i = n; i-- > 0;) {
      if (active_[i] != 0) {
        pivot[i] = 1;
        rest[i] = active_[i] < 0 ? t_.lower[i] : t_.upper[i];
        if (i > 0) rest[t_.parent[i]] -= t_.coupling[i] * rest[i];
      } else if (i > 0) {
        pivot[t_.parent[i]] -= Wide{t_.coupling[i]} * t_.coupling[i] / pivot[i];
        rest[t_.parent[i]] -= t_.coupling[i] * rest[i] / pivot[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const bool tied = i > 0 && active_[i] == 0;
      x_[i] = (rest[i] - (tied ? t_.coupling[i] * x_[t_.parent[i]] : Wide{0})) / pivot[i];
    }
  }

  bool change() {
    std::vector<Wide> force(t_.b.size());  // A x - b
    for (std::size_t i = 0; i < force.size(); ++i) {
      force[i] += t_.diagonal[i] * x_[i] - t_.b[i];
      if (i == 0) continue;
      force[i] += t_.coupling[i] * x_[t_.parent[i]];
      force[t_.parent[i]] += t_.coupling[i] * x_[i];
    }
    bool changed = false;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const int now = active_[i];
      int next = x_[i] < t_.lower[i] ? -1 : x_[i] > t_.upper[i] ? 1 : 0;
      if (now != 0) next = now * force[i] <= 0 ? now : 0;
      active_[i] = static_cast<signed char>(next);
      changed = changed || next != now;
    }
    return changed;
  }

  Wide energy(const std::vector<Wide>& v) const {
    Wide sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      sum += v[i] * (t_.diagonal[i] * v[i] + (i > 0 ? 2 * t_.coupling[i] * v[t_.parent[i]] : Wide{0}));
    return sum;
  }

  const Tree& t_;
  std::vector<Wide> x_;
  std::vector<signed char> active_;
};

/// @param to_the_end whether everything is solved
void expect_honest(Random& random, int n, const Kind& kind, const SolverOptions& options, bool to_the_end) {
  const Tree tree(random, n, kind);
  const BlackBox::Result result = BlackBox(tree.matrix(), 1, options).solve(tree.b, tree.lower, tree.upper);
  const Summary& s = result.summary;
  Exact exact(tree);
  ASSERT_TRUE(exact.find(result.x));
  SCOPED_TRACE(fmt::format("{} springs, 2^{}, {}, error {}: {}", n, kind.decades, options.method, exact.error(result.x),
                           s.reason));
  EXPECT_NE(s.outcome, Outcome::unbounded);
  EXPECT_TRUE(!s.converged() || exact.error(result.x) <= 2 * std::max(s.algebraic_error, options.tolerance));
  EXPECT_TRUE(!to_the_end || s.outcome == Outcome::converged);
}

std::vector<Kind> kinds(int decades) {
  return {{decades, true, false, false, false, 0},  {decades, true, false, false, true, 0},
          {decades, false, false, true, false, 0},  {decades, true, true, true, true, 0},
          {decades, true, false, false, true, 0.2}, {decades, false, false, true, false, 0.2},
          {decades, true, true, true, true, 0.2}};
}

TEST(Refinement, IllConditionedTreesAreSolvedToTheTolerance) {
  Random random(111);
  for (const int n : {5, 22, 68, 150})
    for (const int decades : {10, 30, 36, 40})
      for (const Kind& kind : kinds(decades))
        for (int trial = 0; trial < 3; ++trial) expect_honest(random, n, kind, {}, true);
}

/// A chain of springs whose stiffnesses are powers of two, at rest at integers and partly pressed on bounds there: all
/// numbers of the problem are exact.
struct IntegerChain {
  std::vector<double> spring, x, b, support, lower, upper;
  Matrix A;

  IntegerChain(Random& random, int n, int decades)
      : spring(static_cast<std::size_t>(n)),
        x(spring.size()),
        b(spring.size()),
        support(spring.size()),
        lower(spring.size(), -infinity),
        upper(spring.size(), infinity),
        A(n, n) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int i, int j, double value) {
      entries.emplace_back(i, j, value);
      b[i] += value * x[j];
    };
    for (double& value : x) value = random.below(9) - 4;
    for (int i = 1; i < n; ++i) {
      const double k = spring[i] = std::ldexp(1.0, random.below(decades + 1));
      add(i, i, k), add(i - 1, i - 1, k), add(i, i - 1, -k), add(i - 1, i, -k);
    }
    const int at = random.below(n);
    add(at, at, support[at] = 1);
    const double part = random.between(0, 0.5);
    for (int i = 0; i < n; ++i) {
      if (!random.chance(part)) continue;
      const bool below = random.chance(0.5), touches = random.chance(0.5);
      const int sign = below ? 1 : -1;
      (below ? lower : upper)[i] = x[i] - (touches ? 0 : sign * (1 + random.below(3)));
      if (touches) b[i] -= sign * (1 + random.below(3));
    }
    A.setFromTriplets(entries.begin(), entries.end());
  }

  /// ||other - x||_A / ||x||_A
  double error(const std::vector<double>& other) const {
    std::vector<double> d(x);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = other[i] - x[i];
    return std::sqrt(energy(d) / energy(x));
  }

 private:
  double energy(const std::vector<double>& v) const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      sum += support[i] * v[i] * v[i] + (i > 0 ? spring[i] * (v[i] - v[i - 1]) * (v[i] - v[i - 1]) : 0);
    return sum;
  }
};

// Numbers of the machine next to the solution may be further from it than the tolerance. Which then is said.
TEST(Refinement, StiffChainsAreNotClaimedToBeSolvedBeyondTheMachinesNumbers) {
  for (const int seed : {0, 1, 2, 3, 604, 711, 946, 1273, 1645}) {  // the last five were claimed
    Random random(seed);
    const IntegerChain chain(random, 100 + random.below(200), 44 + random.below(3));
    const BlackBox::Result result = BlackBox(chain.A, 1).solve(chain.b, chain.lower, chain.upper);
    const Summary& s = result.summary;
    if (!s.converged()) continue;
    EXPECT_LE(chain.error(result.x), 2 * std::max(s.algebraic_error, 1e-8)) << seed << ": " << s.reason;
  }
}

// Beyond that, rounding in matrices D A D hides what they are.
TEST(Refinement, WorseConditionedTreesAreNoFalseClaim) {
  Random random(114);
  for (const int n : {5, 22, 68, 150})
    for (const int decades : {43, 46})
      for (const Kind& kind : kinds(decades))
        for (int trial = 0; trial < 3; ++trial) expect_honest(random, n, kind, {}, false);
}

/// A chain of springs of stiffness 2^e, held at one end by one of stiffness 1, with loads of 1 at both ends: the
/// solution is 2 + i / 2^e.
BlackBox::Result solve_weakly_held_chain(int n, int e, double bound) {
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}};
  for (int i = 0; i + 1 < n; ++i)
    for (const auto& [row, column, sign] : {std::tuple(i, i, 1), {i + 1, i + 1, 1}, {i, i + 1, -1}, {i + 1, i, -1}})
      entries.emplace_back(row, column, std::ldexp(sign, e));
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  std::vector<double> b(static_cast<std::size_t>(n), 0), lower;
  b.front() = b.back() = 1;
  if (bound < 0) lower.assign(b.size(), bound);
  return BlackBox(A, 1).solve(b, lower);
}

void expect_is_solution(const std::vector<double>& x, int e) {
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], 2 + std::ldexp(static_cast<double>(i), -e), 2e-8);
}

TEST(Refinement, WeaklyHeldChainsAreSolvedToTheTolerance) {
  for (const int e : {30, 38, 43, 44, 45, 46})
    for (const int n : {2, 3, 10, 50, 400})
      for (const double bound : {0.0, -1e3}) {
        const BlackBox::Result result = solve_weakly_held_chain(n, e, bound);
        SCOPED_TRACE(fmt::format("2^{}, {} unknowns, bound {}: {}", e, n, bound, result.summary.reason));
        EXPECT_EQ(result.summary.outcome, Outcome::converged);
        expect_is_solution(result.x, e);
      }
}

// From 2^53 on, the support is none of the matrix any more.
TEST(Refinement, SupportsThatRoundingHidesAreNoClaim) {
  for (const int n : {2, 3, 10, 50})
    for (const double bound : {0.0, -1e3}) {
      for (const int e : {47, 48, 49, 50, 51, 52}) {
        const BlackBox::Result result = solve_weakly_held_chain(n, e, bound);
        SCOPED_TRACE(fmt::format("2^{}, {} unknowns, bound {}: {}", e, n, bound, result.summary.reason));
        if (result.summary.outcome == Outcome::converged)
          expect_is_solution(result.x, e);
        else
          EXPECT_EQ(result.summary.outcome, Outcome::inaccurate);
      }
      EXPECT_EQ(solve_weakly_held_chain(n, 54, bound).summary.outcome, Outcome::unbounded) << n;
    }
}

// The support is 2^-43 of the spring beside it, and 2^-62 of the stiffest one: its row shows it, solutions do not.
TEST(Refinement, SupportsThatNoFactorisationSeesAreNoClaim) {
  Matrix A(4, 4);
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, 0.25 + std::ldexp(1, -45)},
                                                    {0, 1, -0.25},
                                                    {1, 0, -0.25},
                                                    {1, 1, 131072.25},
                                                    {1, 2, -131072},
                                                    {2, 1, -131072},
                                                    {2, 2, 132096},
                                                    {2, 3, -1024},
                                                    {3, 2, -1024},
                                                    {3, 3, 1024}};
  A.setFromTriplets(entries.begin(), entries.end());
  const Summary s = BlackBox(A, 1).solve(std::vector<double>{-0.3, 1.1, 0.4, -0.7}).summary;
  EXPECT_FALSE(s.converged()) << s.reason;
  EXPECT_NE(s.outcome, Outcome::unbounded) << s.reason;
}

TEST(Refinement, NoMethodClaimsMoreThanItReached) {
  Random random(112);
  for (const char* method : {"monotone", "tnnmg", "pgs", "pdas"}) {
    SolverOptions options;
    options.method = method;
    options.max_iterations = 60;
    for (const int n : {5, 22, 68})
      for (const int decades : {30, 40})
        for (const Kind& kind : kinds(decades)) expect_honest(random, n, kind, options, false);
  }
}

// Few of a tolerance that is hardly attained is missed.
TEST(Refinement, ToleranceOfRounding) {
  Random random(113);
  SolverOptions options;
  options.tolerance = 1e-12;
  for (const Kind& kind : kinds(30))
    for (const int n : {22, 68}) expect_honest(random, n, kind, options, false);
}

// A = M'M with fewer rows of M than columns: rounding gives its motions a little energy, along which nothing is mended.
TEST(Refinement, UnderdeterminedLeastSquaresStaySolved) {
  Random random(5);
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 5 + random.below(60), rows = 1 + random.below(n - 1), decades = trial % 2 ? 3 : 0;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < rows; ++i) {
      const double size = std::pow(10, random.between(0, decades));
      for (int j = 0; j < n; ++j)
        if (random.chance(trial % 4 < 2 ? 1 : 0.2)) entries.emplace_back(i, j, size * random.between(-1, 1));
    }
    Matrix M(rows, n);
    M.setFromTriplets(entries.begin(), entries.end());
    Eigen::VectorXd data(rows);
    for (double& value : data) value = random.between(-1, 1) * std::pow(10, random.between(0, decades));
    const Eigen::VectorXd b = M.transpose() * data;
    const std::vector<double> lower(trial % 3 ? static_cast<std::size_t>(n) : 0, 0.0);
    const Summary s =
        BlackBox(Matrix(M.transpose() * M), 1).solve(std::vector<double>(b.begin(), b.end()), lower).summary;
    EXPECT_TRUE(s.converged()) << trial << ": " << s.reason;
  }
}

// What rounding does not touch has no further stage.
TEST(Refinement, WellConditionedProblemsStayAsTheyAre) {
  for (const int cells : {10, 18}) {
    const Matrix A = laplacian(cells);
    const auto n = static_cast<std::size_t>(A.rows());
    const auto result = BlackBox(A).solve(std::vector<double>(n, 1), {}, std::vector<double>(n, 3));
    EXPECT_EQ(result.summary.outcome, Outcome::converged);
    for (const Stage& stage : result.summary.stages) EXPECT_NE(stage.method, "refinement");
  }
}

}  // namespace
}  // namespace signorini::test
