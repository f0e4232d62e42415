// Friction with a given bound at one vertex.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "core/sdk/given_friction_solver.hpp"
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
  double lower;
};

template <int B>
LocalProblem<B> random_local(Random& random) {
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
  return p;
}

template <int B>
Vec<B> with_given_bound(const LocalProblem<B>& p, double bound) {
  const Eigen::Matrix<double, B, B, Eigen::RowMajor> M = p.M;
  double lower[B], upper[B];
  std::fill_n(lower, B, -infinity);
  std::fill_n(upper, B, infinity);
  lower[0] = p.lower;
  const Slot<B> slot{lower, upper, &bound, p.last.data(), (1u << B) - 2};
  Vec<B> y;
  GivenFrictionSolver<B>::minimise(slot, M.data(), p.r.data(), p.x.data(), y.data());
  return y;
}

template <int B>
void expect_tiny_bounds_hold_nothing() {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = random_local<B>(random);
    const Vec<B> smooth = with_given_bound(p, 0);
    for (const double bound : {1e-20, 1e-150, 1e-200, 1e-308, 5e-324})
      EXPECT_LE((with_given_bound(p, bound) - smooth).norm(), 1e-13 * (1 + smooth.norm())) << bound;
  }
}

TEST(GivenBound, TinyBoundsHoldNothing) {
  expect_tiny_bounds_hold_nothing<2>();
  expect_tiny_bounds_hold_nothing<3>();
}

}  // namespace
}  // namespace signorini::test
