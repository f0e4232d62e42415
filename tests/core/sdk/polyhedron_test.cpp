// The point of a polyhedron next to another one: against all points where some of its sides meet, and by what has to
// hold there.
#include "core/sdk/polyhedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/polyhedra.hpp"

namespace signorini::test {
namespace {

template <int B>
using Vector = Eigen::Matrix<double, B, 1>;
template <int B>
using Matrix = Eigen::Matrix<double, B, B>;

template <int B>
struct HalfSpace {
  Vector<B> normal;  ///< of length one
  double bound;
};

template <int B>
struct Case {
  double lower[B], upper[B];
  std::vector<Facet<B>> facets;
  Matrix<B> M;
  Vector<B> target, inside;

  Polyhedron<B> polyhedron() const { return {lower, upper, facets.data(), facets.data() + facets.size()}; }

  std::vector<HalfSpace<B>> sides() const {
    std::vector<HalfSpace<B>> out;
    const auto add = [&](const Vector<B>& n, double bound) {
      if (bound < infinity) out.push_back({n / n.norm(), bound / n.norm()});
    };
    for (int k = 0; k < B; ++k) {
      add(-Vector<B>::Unit(k), -lower[k]);
      add(Vector<B>::Unit(k), upper[k]);
    }
    for (const Facet<B>& f : facets) {
      const Vector<B> n = Eigen::Map<const Vector<B>>(f.normal);
      add(-n, -f.lower);
      add(n, f.upper);
    }
    return out;
  }

  double energy(const Vector<B>& y) const { return 0.5 * (y - target).dot(M * (y - target)); }
};

template <int B>
Case<B> random_case(Random& random, double angle = -9) {
  Case<B> out;
  for (int k = 0; k < B; ++k) {
    out.inside[k] = random.between(-1, 1);
    out.lower[k] = random.chance(0.5) ? -infinity : out.inside[k] - random.between(0, 0.5);
    out.upper[k] = random.chance(0.7) ? infinity : out.inside[k] + random.between(0, 0.5);
    out.target[k] = random.between(-3, 3);
  }
  out.facets = random_facets<B>(random, 1 + random.below(7), out.inside.data(), angle);
  Matrix<B> G;
  for (int i = 0; i < B * B; ++i) G.data()[i] = random.between(-1, 1);
  out.M = G.transpose() * G + 1e-3 * Matrix<B>::Identity();
  return out;
}

/// The least energy among the minimisers on all sets of up to B sides, in long doubles.
template <int B>
long double least_energy(const Case<B>& c) {
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const auto sides = c.sides();
  const LongMatrix M = c.M.template cast<long double>();
  const Long target = c.target.template cast<long double>();
  long double least = std::numeric_limits<long double>::infinity();
  std::vector<std::size_t> chosen;
  const auto visit = [&](const auto& self, std::size_t next) -> void {
    const auto m = static_cast<Eigen::Index>(chosen.size());
    LongMatrix K = LongMatrix::Zero(B + m, B + m);
    Long b = Long::Zero(B + m);
    K.topLeftCorner(B, B) = M;
    b.head(B) = M * target;
    for (Eigen::Index k = 0; k < m; ++k) {
      K.block(B + k, 0, 1, B) = sides[chosen[k]].normal.transpose().template cast<long double>();
      K.block(0, B + k, B, 1) = K.block(B + k, 0, 1, B).transpose();
      b[B + k] = sides[chosen[k]].bound;
    }
    const Eigen::FullPivLU<LongMatrix> lu(K);
    const Long y = lu.solve(b).head(B);
    bool admissible = (K * lu.solve(b) - b).norm() < 1e-12L;
    for (const auto& side : sides)
      admissible = admissible && side.normal.template cast<long double>().dot(y) - side.bound <= 1e-13L;
    if (admissible) least = std::min(least, 0.5L * (y - target).dot(M * (y - target)));
    if (chosen.size() == B) return;
    for (std::size_t k = next; k < sides.size(); ++k) {
      chosen.push_back(k);
      self(self, k + 1);
      chosen.pop_back();
    }
  };
  visit(visit, 0);
  return least;
}

/// How far the force M (target - y) is from the forces of the sides that y touches, over its size. By all sets of up to
/// B. Where sides are at an angle of 1e-9, rounding moves their corner by 1e-6.
template <int B>
double unbalanced(const Case<B>& c, const Vector<B>& y) {
  const Vector<B> force = c.M * (c.target - y);
  double least = 1;
  std::vector<Vector<B>> touched, chosen;
  for (const auto& side : c.sides())
    if (side.normal.dot(y) - side.bound > -1e-6) touched.push_back(side.normal);
  const auto visit = [&](const auto& self, std::size_t next) -> void {
    if (!chosen.empty()) {
      Eigen::Matrix<double, B, Eigen::Dynamic> N(B, std::ssize(chosen));
      for (std::size_t k = 0; k < chosen.size(); ++k) N.col(static_cast<Eigen::Index>(k)) = chosen[k];
      const Eigen::VectorXd part = N.completeOrthogonalDecomposition().solve(force);
      if (part.minCoeff() >= -1e-9 * force.norm())
        least = std::min(least, (N * part - force).norm() / (force.norm() + 1e-12));
    }
    for (std::size_t k = next; k < touched.size() && chosen.size() < B; ++k) {
      chosen.push_back(touched[k]);
      self(self, k + 1);
      chosen.pop_back();
    }
  };
  visit(visit, 0);
  return force.norm() < 1e-12 ? 0 : least;
}

template <int B>
Vector<B> expect_nearest(const Case<B>& c) {
  const Matrix<B> rows = c.M;  // symmetric
  Vector<B> y;
  EXPECT_TRUE(c.polyhedron().nearest(rows.data(), c.target.data(), y.data()));
  for (const auto& side : c.sides()) EXPECT_LE(side.normal.dot(y) - side.bound, 2e-13);
  for (int k = 0; k < B; ++k) EXPECT_TRUE(y[k] >= c.lower[k] && y[k] <= c.upper[k]);
  return y;
}

template <int B>
void expect_least(int cases) {
  Random random(31 + B);
  for (int trial = 0; trial < cases && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    const Case<B> c = random_case<B>(random, -2);
    const double energy = c.energy(expect_nearest(c));
    EXPECT_NEAR(energy, static_cast<double>(least_energy(c)), 1e-9 * (1 + energy));
  }
}

template <int B>
void expect_balance(int cases) {
  Random random(41 + B);
  for (int trial = 0; trial < cases && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    const Case<B> c = random_case<B>(random);
    EXPECT_LE(unbalanced(c, expect_nearest(c)), 1e-5);
  }
}

TEST(Polyhedron, NearestPointsInThePlaneBalanceForces) { expect_balance<2>(5000); }
TEST(Polyhedron, NearestPointsInSpaceBalanceForces) { expect_balance<3>(5000); }
TEST(Polyhedron, NearestPointsInThePlaneAreThoseOfAllSetsOfSides) { expect_least<2>(4000); }
TEST(Polyhedron, NearestPointsInSpaceAreThoseOfAllSetsOfSides) { expect_least<3>(1500); }

TEST(Polyhedron, WithoutRoomNothingIsNearest) {
  const double none[2] = {-infinity, -infinity}, all[2] = {infinity, infinity}, M[4] = {2, 0, 0, 1}, at[2] = {3, 4};
  Facet<2> f[3] = {{{0, 1}, 0, infinity, 1e-12},
                   {{std::sqrt(0.75), -0.5}, 0, infinity, 1e-12},
                   {{-std::sqrt(0.75), -0.5}, 0, infinity, 1e-12}};
  double y[2];
  ASSERT_TRUE(Polyhedron<2>(none, all, f, f + 3).nearest(M, at, y)) << "one point is left";
  EXPECT_NEAR(y[0], 0, 1e-15);
  EXPECT_NEAR(y[1], 0, 1e-15);
  f[0].lower = 1e-9;
  EXPECT_FALSE(Polyhedron<2>(none, all, f, f + 3).nearest(M, at, y));
}

// What the projector leaves moves within the facets touched, and what is shared stays within the others.
template <int B>
void expect_corrections() {
  Random random(51 + B);
  int free = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const Case<B> c = random_case<B>(random);
    Vector<B> x;
    const Matrix<B> unit = Matrix<B>::Identity();
    ASSERT_TRUE(c.polyhedron().nearest(unit.data(), c.target.data(), x.data()));
    Flags held = 0;
    for (int k = 0; k < B; ++k)
      if (x[k] == c.lower[k] || x[k] == c.upper[k]) held |= static_cast<Flags>(1u << k);
    double P[B * B], lower[B], upper[B];
    c.polyhedron().hold(x.data(), held, P);
    for (int k = 0; k < B; ++k) {
      lower[k] = std::max(c.lower[k] - x[k], -2.0);
      upper[k] = std::min(c.upper[k] - x[k], 2.0);
    }
    c.polyhedron().share(x.data(), P, lower, upper);
    for (int sample = 0; sample < 20; ++sample) {
      double d[B], moved[B];
      for (double& v : d) v = random.between(-2, 2);
      block::product<B>(P, d, moved);
      double part = 1;
      for (int k = 0; k < B; ++k) {
        if (moved[k] > 0) part = std::min(part, upper[k] / moved[k]);
        if (moved[k] < 0) part = std::min(part, lower[k] / moved[k]);
      }
      free += part > 1e-3 && block::norm<B>(moved) > 1e-3;
      Vector<B> y = x;
      for (int k = 0; k < B; ++k) y[k] += part * moved[k];
      for (const auto& side : c.sides()) ASSERT_LE(side.normal.dot(y) - side.bound, 2e-12);
    }
  }
  EXPECT_GT(free, 3000) << "corrections are held back";
}

TEST(Polyhedron, CorrectionsInThePlaneStayAdmissible) { expect_corrections<2>(); }
TEST(Polyhedron, CorrectionsInSpaceStayAdmissible) { expect_corrections<3>(); }

}  // namespace
}  // namespace signorini::test
