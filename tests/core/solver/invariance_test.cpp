// What must not change the answer: units, the numbering of the vectors, the fineness of the mesh, threads.
#include <gtest/gtest.h>

#include "core/solver/passes.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

template <int B>
void scale(Nested<B>& nested, double matrix, double unknown) {
  for (DiscreteProblem<B>& p : nested.levels) {
    for (Index q = 0; q < p.A.size(); ++q)
      for (Offset k = p.A.row[q]; k < p.A.row[q + 1]; ++k)
        for (int i = 0; i < B; ++i)
          for (int j = 0; j < B; ++j)
            if (!(p.fixed[q] >> i & 1) && !(p.fixed[p.A.column[k]] >> j & 1)) p.A.at(k)[i * B + j] *= matrix;
    for (std::size_t i = 0; i < p.b.size(); ++i) p.b[i] *= p.fixed[i / B] >> (i % B) & 1 ? unknown : matrix * unknown;
    for (double& v : p.start) v *= unknown;
    for (double& v : p.constraints.lower) v *= unknown;
    for (double& v : p.constraints.upper) v *= unknown;
    p.prescribed_energy *= matrix * unknown * unknown;
    p.prescribed_work *= matrix * unknown * unknown;
    for (double& v : p.coupling) v *= matrix * unknown;
  }
}

template <int B>
void expect_independent_of_units(const Case<B>& c) {
  std::vector<double> x;
  const Summary original = solve_from_zero(c.nested, x);
  const auto solve_scaled = [&](double matrix, double unknown) {
    Nested<B> other = c.nested;
    scale(other, matrix, unknown);
    std::vector<double> y;
    const Summary scaled = solve_from_zero(other, y);
    EXPECT_EQ(scaled.iterations, original.iterations) << c.name << ", " << matrix << ", " << unknown;
    EXPECT_EQ(scaled.outcome, original.outcome) << c.name << ", " << matrix << ", " << unknown;
    for (double& v : y) v /= unknown;
    return y;
  };
  // Powers of two change no rounding.
  EXPECT_EQ(solve_scaled(0x1p-20, 0x1p10), x) << c.name;
  EXPECT_EQ(solve_scaled(0x1p30, 0x1p-10), x) << c.name;
  // Where contact carries no force rounding decides about it.
  if (c.name.find("biactive") != std::string::npos) return;
  for (const double matrix : {1e-6, 1e9})
    for (const double unknown : {1e-3, 1e3})
      EXPECT_LE((vector(solve_scaled(matrix, unknown)) - vector(x)).norm(), 1e-12 * vector(x).norm()) << c.name;
}

TEST(Invariance, UnitsOfTheDiscreteProblem) {
  for (const auto& c : scalar_cases()) expect_independent_of_units(c);
  for (const auto& c : plane_cases()) expect_independent_of_units(c);
  for (const auto& c : space_cases()) expect_independent_of_units(c);
}

// The scene in units of a thousandth: coordinates, displacements and bounds by 1e3, moduli and loads by 1e-6.
TEST(Invariance, UnitsOfTheScene) {
  const auto block = [](double length, double modulus) {
    Model<2> model = pressed_block<2>(sphere<2>({0.4 * length, -length}, 0.98 * length), 0.08 * length);
    model.young = Field(modulus);
    return discretize_all<2, 2>(cube<2>(0, length, 2), 3, model);
  };
  std::vector<double> x, y;
  const auto metres = block(1, 1), millimetres = block(1e3, 1e-6);
  const Summary first = solve_from_zero(metres, x), second = solve_from_zero(millimetres, y);
  EXPECT_EQ(first.iterations, second.iterations);
  EXPECT_LE((vector(y) / 1e3 - vector(x)).norm(), 1e-10 * vector(x).norm());
}

std::vector<Index> shuffled(Random& random, Index n) {
  std::vector<Index> order(static_cast<std::size_t>(n));
  for (Index p = 0; p < n; ++p) order[p] = p;
  for (Index p = n - 1; p > 0; --p) std::swap(order[p], order[random.below(p + 1)]);
  return order;
}

// `to[p]` is the new number of vector p.
template <int B>
DiscreteProblem<B> renumbered(const DiscreteProblem<B>& p, const std::vector<Index>& to) {
  const auto n = static_cast<std::size_t>(p.A.size());
  std::vector<Index> from(n);
  for (std::size_t q = 0; q < n; ++q) from[to[q]] = static_cast<Index>(q);
  DiscreteProblem<B> out = p;
  out.A = {};
  out.frames = {};
  out.constraints = {};
  out.constraints.slot.assign(n, -1);
  for (std::size_t row = 0; row < n; ++row) {
    const Index old = from[row];
    std::vector<std::pair<Index, Offset>> entries;
    for (Offset k = p.A.row[old]; k < p.A.row[old + 1]; ++k) entries.emplace_back(to[p.A.column[k]], k);
    std::sort(entries.begin() + 1, entries.end());
    for (const auto& [column, k] : entries) {
      out.A.column.push_back(column);
      out.A.value.insert(out.A.value.end(), p.A.at(k), p.A.at(k) + B * B);
    }
    out.A.row.push_back(static_cast<Offset>(out.A.column.size()));
    out.fixed[row] = p.fixed[old];
    std::copy_n(p.b.begin() + old * B, B, out.b.begin() + static_cast<std::ptrdiff_t>(row) * B);
    std::copy_n(p.start.begin() + old * B, B, out.start.begin() + static_cast<std::ptrdiff_t>(row) * B);
    if (const double* Q = p.frames.at(old)) out.frames.add(n, static_cast<Index>(row), Q, p.frames.dual_at(old));
    if (const Index slot = p.constraints.slot[old]; slot >= 0) {
      out.constraints.slot[row] = out.constraints.size();
      out.constraints.vector.push_back(static_cast<Index>(row));
      for (int k = 0; k < B; ++k) {
        out.constraints.lower.push_back(p.constraints.lower[slot * B + k]);
        out.constraints.upper.push_back(p.constraints.upper[slot * B + k]);
      }
    }
  }
  for (Index& q : out.coupled) q = to[q];  // their order does not matter to sums
  if (!p.segments.empty()) out.segments = {{0, static_cast<Index>(n), p.segments.front().obstacle}};
  return out;
}

Prolongation renumbered(const Prolongation& P, const std::vector<Index>& coarse, const std::vector<Index>& fine) {
  std::vector<Index> from(fine.size());
  for (std::size_t p = 0; p < fine.size(); ++p) from[fine[p]] = static_cast<Index>(p);
  Prolongation out;
  out.coarse = P.coarse;
  for (const Index p : from) {
    std::vector<std::pair<Index, double>> row;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) row.emplace_back(coarse[P.column[k]], P.weight[k]);
    std::sort(row.begin(), row.end());
    for (const auto& [q, weight] : row) {
      out.column.push_back(q);
      out.weight.push_back(weight);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

struct Renumbered {
  Eigen::VectorXd x;  // in the original numbering
  int iterations;
};

// Solves the problem with all levels renumbered at random.
template <int B>
Renumbered solve_renumbered(const Nested<B>& nested, const SolverOptions& options, Random& random) {
  std::vector<std::vector<Index>> to;
  Nested<B> other;
  for (const DiscreteProblem<B>& p : nested.levels) {
    to.push_back(shuffled(random, p.A.size()));
    other.levels.push_back(renumbered(p, to.back()));
  }
  for (std::size_t k = 0; k < nested.prolongations.size(); ++k)
    other.prolongations.push_back(renumbered(nested.prolongations[k], to[k], to[k + 1]));
  std::vector<double> x;
  Renumbered out;
  out.iterations = solve_from_zero(other, x, options).iterations;
  out.x.resize(static_cast<Eigen::Index>(x.size()));
  for (std::size_t p = 0; p < to.back().size(); ++p)
    for (int k = 0; k < B; ++k) out.x[static_cast<Eigen::Index>(p) * B + k] = x[to.back()[p] * B + k];
  return out;
}

// The mean number of iterations over some random orders, whose solutions all are x.
template <int B>
double mean_iterations(const Case<B>& c, const SolverOptions& options, const std::vector<double>& x, Random& random) {
  constexpr int orders = 6;
  int sum = 0;
  for (int k = 0; k < orders; ++k) {
    const Renumbered other = solve_renumbered(c.nested, options, random);
    EXPECT_LE((other.x - vector(x)).norm(), 1e-8 * vector(x).norm()) << c.name;
    sum += other.iterations;
  }
  return double(sum) / orders;
}

// A random order smooths a little worse than the order of the refinement, which runs along the elements. Means, since
// it is up to rounding when biactive vectors are truncated.
template <int B>
void expect_independent_of_numbering(const Case<B>& c, Random& random) {
  SolverOptions options;
  options.smoother = "symmetric";
  options.tolerance = 1e-9;
  std::vector<double> x;
  const Summary original = solve_from_zero(c.nested, x, options);
  const double first = mean_iterations(c, options, x, random), second = mean_iterations(c, options, x, random);
  EXPECT_NEAR(first, second, 1) << c.name;
  EXPECT_LE(original.iterations, first + 1) << c.name;
}

TEST(Invariance, NumberingOfTheVectors) {
  Random random(51);
  for (const auto& c : scalar_cases()) expect_independent_of_numbering(c, random);
  for (const auto& c : plane_cases()) expect_independent_of_numbering(c, random);
  for (const auto& c : space_cases()) expect_independent_of_numbering(c, random);
}

template <int B>
void expect_mesh_independence(const std::string& name, const Nested<B>& finest, std::size_t first) {
  int last = 1000;
  for (std::size_t levels = first; levels <= finest.levels.size(); ++levels) {
    const auto end = static_cast<std::ptrdiff_t>(levels);
    Nested<B> here;
    here.levels.assign(finest.levels.begin(), finest.levels.begin() + end);
    here.prolongations.assign(finest.prolongations.begin(), finest.prolongations.begin() + end - 1);
    std::vector<double> x;
    const Summary s = solve_nested(here, x);
    EXPECT_TRUE(s.converged());
    EXPECT_LE(s.iterations, last + 1) << name << ", " << levels << " levels";
    last = s.iterations;
  }
}

TEST(Invariance, IterationsDoNotGrowWithTheMesh) {
  expect_mesh_independence("radial2", discretize_all<2, 1>(cube<2>(-2, 2, 4), 6, radial_model<2>()), 4);
  expect_mesh_independence("radial3", discretize_all<3, 1>(cube<3>(-2, 2, 3), 3, radial_model<3>()), 3);
}

TEST(Invariance, IterationsDoNotGrowWithTheMeshInElasticContact) {
  const auto circle = pressed_block<2>(sphere<2>({0.4, -1}, 0.98), 0.08);
  expect_mesh_independence("circle", discretize_all<2, 2>(cube<2>(0, 1, 2), 6, circle), 4);
  const auto held = resting_block<2>({3, -1}, {"left"});
  expect_mesh_independence("held", discretize_all<2, 2>(cube<2>(0, 1, 2), 6, held), 4);
}

// Bitwise, iterates of every cycle: what a cycle does next depends on all that came before.
template <int B>
void expect_independent_of_threads(const Nested<B>& nested) {
  ASSERT_GT(divide(nested.levels.back().A).count(), 8) << "too small for threads";
  const auto solve_with = [&](int threads) {
    SolverOptions options;
    options.threads = threads;
    std::vector<double> x;
    const Summary s = solve_from_zero(nested, x, options);
    EXPECT_TRUE(s.converged());
    for (const IterationRecord& cycle : s.history)
      x.insert(x.end(), {cycle.energy, cycle.residual, cycle.algebraic_error});
    return x;
  };
  const std::vector<double> alone = solve_with(1);
  for (const int threads : {2, 5}) EXPECT_EQ(solve_with(threads), alone) << threads << " threads";
}

TEST(Invariance, Threads) {
  expect_independent_of_threads(discretize_all<2, 1>(cube<2>(-2, 2, 5), 6, radial_model<2>()));
  expect_independent_of_threads(
      discretize_all<3, 3>(cube<3>(0, 1, 3), 3, pressed_block<3>(sphere<3>({0.4, 0.55, -1}, 0.98), 0.08)));
}

}  // namespace
}  // namespace signorini::test
