// What rounding leaves of the accuracy, against closed forms: errors are estimated, and never below what they are.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Springs in a row, the first one held, with stiffnesses that are powers of two: sums of two of them are exact.
struct Chain {
  std::vector<double> stiffness, load;

  Chain(Random& random, std::size_t n, int most) {
    for (std::size_t i = 0; i < n; ++i) {
      stiffness.push_back(std::ldexp(1, random.below(most + 1)));
      load.push_back(random.between(-1, 1));
    }
  }

  Matrix matrix() const {
    const auto n = static_cast<Index>(load.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < n; ++i) {
      entries.emplace_back(i, i, stiffness[i]);
      if (i == 0) continue;
      entries.emplace_back(i - 1, i - 1, stiffness[i]);
      entries.emplace_back(i, i - 1, -stiffness[i]);
      entries.emplace_back(i - 1, i, -stiffness[i]);
    }
    Matrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }

  double condition() const {
    const auto [least, most] = std::ranges::minmax(stiffness);
    return most / least;
  }

  /// ||x - x*||_A / ||x*||_A: a spring carries the loads behind it.
  double error(const std::vector<double>& x) const {
    long double carried = 0, error = 0, size = 0;
    for (std::size_t i = load.size(); i-- > 0;) {
      carried += load[i];
      const long double stretch = carried / stiffness[i];
      const long double found = static_cast<long double>(x[i]) - (i > 0 ? x[i - 1] : 0);
      error += stiffness[i] * (found - stretch) * (found - stretch);
      size += stiffness[i] * stretch * stretch;
    }
    return static_cast<double>(std::sqrt(error / size));
  }
};

void expect_contained(const Summary& s, double error) {
  const bool limited = s.outcome == Outcome::rounding || s.outcome == Outcome::inaccurate;
  EXPECT_TRUE(limited || s.outcome == Outcome::converged) << s.reason;
  EXPECT_EQ(limited, std::max(s.algebraic_error, s.residual) > 1e-8) << s.reason;
  EXPECT_LE(error, 2 * std::max(s.algebraic_error, 1e-8)) << s.reason;
}

// They are refined with residuals in extended precision.
TEST(Attainable, ErrorsOfIllConditionedChainsAreContained) {
  Random random(91);
  for (const auto& [n, decades] : {std::pair{22, 20}, {22, 30}, {22, 40}, {68, 20}, {68, 30}, {300, 20}, {300, 30}})
    for (int trial = 0; trial < 10; ++trial) {
      SCOPED_TRACE(fmt::format("{} springs, stiffness up to 2^{}, trial {}", n, decades, trial));
      const Chain chain(random, static_cast<std::size_t>(n), decades);
      const BlackBox::Result result = BlackBox(chain.matrix()).solve(chain.load);
      expect_contained(result.summary, chain.error(result.x));
      EXPECT_EQ(result.summary.outcome, Outcome::converged);
    }
}

// Accelerated cycles extrapolate residuals, and what rounding does to them: that must not carry the iterate away.
TEST(Attainable, EnergiesOfCyclesFallOnIllConditionedChains) {
  Random random(92);
  int steps = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Chain chain(random, 23, 45 + trial % 10);
    // A cycle in double precision misses its minimum by so much of the solution, and the energy by the square of that.
    // Processors without fused multiply-add show it.
    const double missed = std::numeric_limits<double>::epsilon() * chain.condition(),
                 rounding = missed * missed + 1e-13;
    const Summary s = BlackBox(chain.matrix()).solve(chain.load).summary;
    for (std::size_t k = 1; k < s.history.size(); ++k) {
      const IterationRecord &before = s.history[k - 1], &now = s.history[k];
      if (before.stage != now.stage || !s.stages[now.stage].linear.empty()) continue;  // no cycles
      EXPECT_LE(now.energy, before.energy + rounding * std::abs(now.energy)) << "chain " << trial << ", step " << k;
      ++steps;
    }
  }
  EXPECT_GT(steps, 1000);
}

/// The solution of A x = b by refinement with residuals in extended precision, and its distance from x, relative, in
/// the energy norm.
double error_of(const Matrix& A, const std::vector<double>& b, const std::vector<double>& x) {
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Eigen::SparseMatrix<long double> wide = A.cast<long double>();
  const Eigen::SimplicialLDLT<Matrix> factor(A);
  const Vector load = vector(b).cast<long double>();
  Vector exact = Vector::Zero(load.size());
  for (int k = 0; k < 30; ++k) {
    const Vector r = load - wide * exact;
    exact += factor.solve(Eigen::VectorXd(r.cast<double>())).cast<long double>();
  }
  const Vector e = vector(x).cast<long double>() - exact;
  return static_cast<double>(std::sqrt(e.dot(wide * e) / exact.dot(wide * exact)));
}

// Its bending has little energy beside that of its cells.
TEST(Attainable, ErrorsOfSlenderBeamsAreContained) {
  Model<2> model = resting_block<2>({0, -1e-6}, {});
  model.obstacles.clear();
  model.fixes = {{on("left"), {Field(0), Field(0)}}};
  for (const int slenderness : {5, 300}) {
    SCOPED_TRACE(slenderness);
    Mesh<2> mesh = cube<2>(0, 1, 24);
    for (auto& point : mesh.points) point[0] *= slenderness;
    const Given<2> given(discretize<2, 2>(mesh, model).problem);
    const BlackBox::Result result = BlackBox(given.A, 2).solve(given.b);
    expect_contained(result.summary, error_of(given.A, given.b, result.x));
    EXPECT_EQ(result.summary.outcome, slenderness == 5 ? Outcome::converged : Outcome::rounding);
  }
}

// Nor are they far above.
TEST(Attainable, WellConditionedMatricesAreNotLimited) {
  for (const int cells : {10, 40, 100}) {
    const Matrix A = laplacian(cells);
    const Eigen::VectorXd exact = vector(waves(static_cast<std::size_t>(A.rows()))), b = A * exact;
    SolverOptions options;
    options.tolerance = 1e-12;
    const BlackBox::Result result = BlackBox(A, 1, options).solve(std::vector<double>(b.begin(), b.end()));
    EXPECT_EQ(result.summary.outcome, Outcome::converged) << result.summary.reason;
    EXPECT_LE(result.summary.rounding_error, 1e-12) << cells;
    const Eigen::VectorXd e = vector(result.x) - exact;
    EXPECT_LE(std::sqrt(e.dot(A * e) / exact.dot(A * exact)), 3e-12);
  }
}

}  // namespace
}  // namespace signorini::test
