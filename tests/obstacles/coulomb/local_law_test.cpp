// Coulomb's law at one vertex: against all solutions there are, found by trying every state and direction of slip.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <vector>

#include "core/sdk/coulomb_friction.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

template <int B>
using Vec = Eigen::Matrix<double, B, 1>;

/// The first component is the normal one.
template <int B>
struct LocalProblem {
  Eigen::Matrix<double, B, B> M;
  Vec<B> r, x, last;
  double lower, friction;

  /// Forces that are left where the vertex is at y.
  Vec<B> left(const Vec<B>& y) const { return r - M * (y - x); }
};

template <int B>
LocalProblem<B> random_local(Random& random, double friction) {
  LocalProblem<B> p;
  Eigen::Matrix<double, B, B> G;
  for (int i = 0; i < B * B; ++i) G.data()[i] = random.between(-1, 1);
  p.M = G.transpose() * G + 0.2 * Eigen::Matrix<double, B, B>::Identity();
  for (int i = 0; i < B; ++i) {
    p.r[i] = random.between(-2, 2);
    p.last[i] = random.between(-0.5, 0.5);
    p.x[i] = random.between(-0.5, 0.5);
  }
  p.lower = random.between(-0.5, 0.5);
  p.x[0] = std::max(p.x[0], p.lower);
  p.friction = friction;
  return p;
}

/// Where friction acts along -e with all its force and the vertex touches.
template <int B>
Vec<B> slipped(const LocalProblem<B>& p, const Vec<B>& e) {
  // M (y - x) = r - f, f = N (mu e - n): the unknowns are N and the tangential part of y.
  Eigen::Matrix<double, B, B> K = p.M;
  const Vec<B> f = p.friction * e - Vec<B>::Unit(0);
  K.col(0) = f;
  const Vec<B> start = p.M.col(0) * (p.lower - p.x[0]);
  Vec<B> solution = K.fullPivLu().solve(p.r - start);
  Vec<B> y = p.x + solution;
  y[0] = p.lower;
  return y;
}

template <int B>
bool is_solution(const LocalProblem<B>& p, const Vec<B>& y, double tolerance) {
  const Vec<B> left = p.left(y);
  if (y[0] < p.lower - tolerance || left[0] > tolerance) return false;
  const double N = -left[0];
  if (std::abs(N * (y[0] - p.lower)) > tolerance) return false;
  const Vec<B> n = Vec<B>::Unit(0), force = left - left[0] * n, slip = (y - p.last) - (y - p.last)[0] * n;
  if (slip.norm() <= tolerance) return force.norm() <= p.friction * N + tolerance;
  return (force - p.friction * N * slip.normalized()).norm() <= tolerance * (1 + 1 / slip.norm());
}

/// Every solution.
template <int B>
std::vector<Vec<B>> solutions(const LocalProblem<B>& p) {
  constexpr double tolerance = 1e-9;
  std::vector<Vec<B>> out;
  const auto add = [&](const Vec<B>& y) {
    if (is_solution(p, y, tolerance)) out.push_back(y);
  };
  add(p.x + p.M.llt().solve(p.r));
  Vec<B> sticks = p.last;
  sticks[0] = p.lower;
  add(sticks);
  if constexpr (B == 2) {
    for (const double way : {-1.0, 1.0}) add(slipped<2>(p, Vec<2>(0, way)));
  } else {
    const auto direction = [](double angle) { return Vec<3>(0, std::cos(angle), std::sin(angle)); };
    const auto across = [&](double angle) {
      const Vec<3> e = direction(angle), w = slipped<3>(p, e) - p.last;
      return w[1] * e[2] - w[2] * e[1];
    };
    constexpr int tried = 2000;
    for (int k = 0; k < tried; ++k) {
      double a = 2 * std::numbers::pi * k / tried, b = 2 * std::numbers::pi * (k + 1) / tried;
      if ((across(a) > 0) == (across(b) > 0)) continue;
      for (int step = 0; step < 60; ++step) {
        const double c = 0.5 * (a + b);
        ((across(c) > 0) == (across(a) > 0) ? a : b) = c;
      }
      add(slipped<3>(p, direction(a)));
    }
  }
  return out;
}

template <int B>
Vec<B> solved(const LocalProblem<B>& p, double guess) {
  const Eigen::Matrix<double, B, B, Eigen::RowMajor> M = p.M;
  const double data[] = {guess, p.friction};
  double lower[B], upper[B];
  std::fill_n(lower, B, -infinity);
  std::fill_n(upper, B, infinity);
  lower[0] = p.lower;
  const Slot<B> slot{lower, upper, data, p.last.data(), (1u << B) - 2, false};
  Vec<B> y;
  CoulombSolver<B>::minimise(slot, M.data(), p.r.data(), p.x.data(), y.data());
  return y;
}

template <int B>
void expect_solved() {
  Random random(40 + B);
  int slips = 0, sticks = 0, opens = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    const auto p = random_local<B>(random, trial % 10 == 0 ? 0 : random.between(0, 5));
    const double guess = p.friction == 0 || random.chance(0.3) ? 0 : random.between(0, 3);
    const Vec<B> y = solved(p, guess);
    const auto all = solutions(p);
    ASSERT_FALSE(all.empty()) << "no solution: the reference is wrong";
    double nearest = infinity;
    for (const Vec<B>& other : all) nearest = std::min(nearest, (y - other).norm());
    ASSERT_LE(nearest, 1e-9) << "friction " << p.friction << ", solutions " << all.size();
    ASSERT_TRUE(is_solution(p, y, 1e-13)) << "not to rounding";
    // Bounds and sticking are met exactly.
    const bool touches = y[0] == p.lower, rests = (y - p.last).tail(B - 1).isZero(0);
    ASSERT_TRUE(touches || p.left(y).norm() <= 1e-13);
    opens += !touches;
    sticks += touches && rests;
    slips += touches && !rests;
  }
  for (const int count : {slips, sticks, opens}) EXPECT_GT(count, 50) << "a state hardly ever met: no test";
}

TEST(CoulombLocalLaw, IsSolvedInThePlane) { expect_solved<2>(); }
TEST(CoulombLocalLaw, IsSolvedInSpace) { expect_solved<3>(); }

TEST(CoulombLocalLaw, FrozenItIsFrictionWithAGivenBound) {
  Random random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = random_local<3>(random, 0.7);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> M = p.M;
    const double data[] = {random.between(0, 2), 0.7}, lower[] = {p.lower, -infinity, -infinity},
                 upper[] = {infinity, infinity, infinity};
    Vec<3> frozen, given;
    Slot<3> slot{lower, upper, data, p.last.data(), 6, true};
    CoulombSolver<3>::minimise(slot, M.data(), p.r.data(), p.x.data(), frozen.data());
    GivenFrictionSolver<3>::minimise(slot, M.data(), p.r.data(), p.x.data(), given.data());
    EXPECT_EQ(frozen, given);
  }
}

template <int B>
Vec<B> with_given_bound(const LocalProblem<B>& p, double bound) {
  const Eigen::Matrix<double, B, B, Eigen::RowMajor> M = p.M;
  double lower[B], upper[B];
  std::fill_n(lower, B, -infinity);
  std::fill_n(upper, B, infinity);
  lower[0] = p.lower;
  const Slot<B> slot{lower, upper, &bound, p.last.data(), (1u << B) - 2, true};
  Vec<B> y;
  GivenFrictionSolver<B>::minimise(slot, M.data(), p.r.data(), p.x.data(), y.data());
  return y;
}

template <int B>
void expect_tiny_bounds_hold_nothing() {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = random_local<B>(random, 0.3);
    const Vec<B> smooth = with_given_bound(p, 0);
    for (const double bound : {1e-20, 1e-150, 1e-200, 1e-308, 5e-324})
      EXPECT_LE((with_given_bound(p, bound) - smooth).norm(), 1e-13 * (1 + smooth.norm())) << bound;
  }
}

TEST(CoulombLocalLaw, TinyBoundsHoldNothing) {
  expect_tiny_bounds_hold_nothing<2>();
  expect_tiny_bounds_hold_nothing<3>();
}

}  // namespace
}  // namespace signorini::test
