// FGMRES on matrices without symmetry, against the solution that the right-hand side was made from.
#include "core/algebra/flexible_gmres.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace signorini {
namespace {

using Vector = std::vector<double>;

constexpr std::size_t n = 60;

/// A convection with diffusion, and entries at random.
struct Matrix {
  std::vector<Vector> row{n, Vector(n)};

  explicit Matrix(unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> of(-0.02, 0.02);
    for (std::size_t i = 0; i < n; ++i) {
      for (double& entry : row[i]) entry = of(generator);
      row[i][i] += 3;
      if (i > 0) row[i][i - 1] -= 1.9;
      if (i + 1 < n) row[i][i + 1] -= 0.3;
    }
  }
  void operator()(const Vector& v, Vector& out) const {
    for (std::size_t i = 0; i < n; ++i) out[i] = dot(row[i], v);
  }
};

Vector solution() {
  Vector x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(0.3 * static_cast<double>(i * i));
  return x;
}

void copy(const Vector& v, Vector& out) { out = v; }

TEST(FlexibleGmres, FindsTheSolutionWithAndWithoutRestarts) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Matrix K(seed);
    const Vector exact = solution();
    Vector b(n), x;
    K(exact, b);
    for (const int restart : {60, 10}) {
      const KrylovResult found = flexible_gmres(K, copy, b, x, {1e-12, restart, 400});
      EXPECT_LE(found.residual, 1e-12);
      EXPECT_LT(found.applications, restart == 60 ? 61 : 400);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], exact[i], 1e-10);
    }
  }
}

TEST(FlexibleGmres, PreconditionersMayDifferFromOneApplicationToTheNext) {
  const Matrix K(4);
  const Vector exact = solution();
  Vector b(n), x;
  K(exact, b);
  int turn = 0;
  const auto scale = [&](const Vector& v, Vector& out) {
    out = v;
    const double by = ++turn % 2 == 0 ? 0.3 : 2;
    for (std::size_t i = 0; i < n; ++i)
      out[i] *= by + 0.1 * static_cast<double>((i + static_cast<std::size_t>(turn)) % 3);
  };
  EXPECT_LE(flexible_gmres(K, scale, b, x, {1e-12, 100, 400}).residual, 1e-12);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], exact[i], 1e-10);
}

TEST(FlexibleGmres, EndsWhereThereIsNothingToDo) {
  Vector x;
  EXPECT_EQ(flexible_gmres(Matrix(1), copy, Vector(n), x, {}).applications, 0);
  EXPECT_THAT(x, testing::Each(0.0));
  EXPECT_EQ(flexible_gmres(copy, copy, solution(), x, {}).applications, 1);
  const Vector exact = solution();
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], exact[i], 1e-14);
}

TEST(FlexibleGmres, SaysWhatIsLeftWhereItFindsNothing) {
  Vector x;
  const auto nothing = [](const Vector&, Vector& out) { std::fill(out.begin(), out.end(), 0.0); };
  EXPECT_EQ(flexible_gmres(nothing, copy, solution(), x, {}).residual, 1);
  const auto no_number = [](const Vector&, Vector& out) {
    std::fill(out.begin(), out.end(), std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_FALSE(flexible_gmres(no_number, copy, solution(), x, {}).residual <= 1);
}

}  // namespace
}  // namespace signorini
