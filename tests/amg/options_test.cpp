// Options of algebraic levels: with each of them all problems are solved with falling energies, and each does what it
// says.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "amg/coarsening/reach_from_twins.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/configuration.hpp"
#include "methods/solve.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

template <int B>
std::unique_ptr<Transfer<B>> min_merge() {
  return registry().create<Transfer<B>>("transfer", "min_merge");
}

template <int B>
AlgebraicLevels<B> levels_below(const DiscreteProblem<B>& problem, const SolverOptions& options) {
  return algebraic_hierarchy<B>(problem, min_merge<B>, 20, algebraic_settings(options));
}

template <int B>
const Case<B>& named(const std::vector<Case<B>>& cases, const std::string& name) {
  return *std::ranges::find(cases, name, &Case<B>::name);
}

/// Solves from zero; energies fall and the solution is that of the reference solver.
template <int B>
Summary expect_solved(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                      SolverOptions options) {
  options.tolerance = 1e-9;
  std::vector<double> x = problem.start;
  double last = infinity, scale = problem.prescribed_energy;
  const Summary summary = solve<B>(problem, prolongations, x, options, registry(), [&](const IterationRecord& r) {
    scale = std::max(scale, std::abs(r.energy));
    EXPECT_LE(r.energy, last + 1e-13 * scale) << "cycle " << r.iteration;
    last = r.energy;
    return true;
  });
  EXPECT_TRUE(summary.converged()) << summary.reason;
  const Reference exact = reference(problem);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm());
  return summary;
}

/// On algebraic levels alone.
template <int B>
Summary expect_solved(DiscreteProblem<B> problem, const SolverOptions& options) {
  const AlgebraicLevels<B> levels = levels_below(problem, options);
  EXPECT_GE(levels.prolongations.size(), 1u);
  problem.galerkin = levels.matrices;
  return expect_solved<B>(problem, levels.prolongations, options);
}

using Choice = std::tuple<bool, std::string, std::string, std::string, std::string>;

SolverOptions options_of(const Choice& choice) {
  SolverOptions options;
  std::tie(options.reassemble, options.reach, options.interpolate, options.rotate, options.method) = choice;
  return options;
}

class AlgebraicOptions : public testing::TestWithParam<Choice> {};

TEST_P(AlgebraicOptions, ReachTheSolutionWithFallingEnergies) {
  static const auto scalar = scalar_cases();
  static const auto plane = plane_cases();
  for (const char* name : {"two_sided", "hill"}) {
    SCOPED_TRACE(name);
    expect_solved(named(scalar, name).nested.finest(), options_of(GetParam()));
  }
  for (const char* name : {"incline", "circle", "held"}) {
    SCOPED_TRACE(name);
    expect_solved(named(plane, name).nested.finest(), options_of(GetParam()));
  }
}

std::string name_of(const testing::TestParamInfo<Choice>& info) {
  const auto& [reassemble, reach, interpolate, rotate, method] = info.param;
  return fmt::format("{}_{}_{}_{}_{}", reassemble ? "reassembled" : "lasting", reach, interpolate, rotate, method);
}

INSTANTIATE_TEST_SUITE_P(Combined, AlgebraicOptions,
                         testing::Combine(testing::Bool(), testing::Values("all", "twins"),
                                          testing::Values("global", "local"),
                                          testing::Values("all", "not_coarsest", "meshes", "none"),
                                          testing::Values("monotone", "tnnmg")),
                         name_of);

/// Meshes with algebraic levels below the coarsest one.
struct Hybrid {
  Nested<2> nested = discretize_all<2, 2>(cube<2>(0, 1, 10), 1, pressed_block<2>(sphere<2>({0.4, -1}, 0.98), 0.08));
  AlgebraicLevels<2> below;
  std::vector<Prolongation> prolongations;

  explicit Hybrid(const SolverOptions& options) : below(levels_below(nested.levels.front(), options)) {
    prolongations = below.prolongations;
    prolongations.insert(prolongations.end(), nested.prolongations.begin(), nested.prolongations.end());
  }
};

TEST(Reassemble, OffKeepsTheMatricesOfAlgebraicLevelsAlone) {
  for (const bool on : {true, false}) {
    SolverOptions options;
    options.reassemble = on;
    const Hybrid hybrid(options);
    const Summary summary = expect_solved<2>(hybrid.nested.finest(), hybrid.prolongations, options);
    Index renewed_algebraic = 0, renewed_mesh = 0;
    for (const IterationRecord& record : summary.history)
      for (std::size_t k = 0; k < record.levels.size(); ++k)
        (k < hybrid.below.prolongations.size() ? renewed_algebraic : renewed_mesh) += record.levels[k].renewed;
    EXPECT_GT(renewed_mesh, 0);
    EXPECT_EQ(renewed_algebraic > 0, on);
  }
}

TEST(Rotate, MeshesLeavesAlgebraicLevelsInGlobalCoordinates) {
  const Hybrid hybrid{{}};
  SolverOptions options;
  options.rotate = "meshes";
  const MonotoneMultigrid<2> method(hybrid.nested.finest(), hybrid.prolongations, components_of<2>(options, registry()),
                                    settings_of<2>(options));
  for (std::size_t k = 0; k < method.levels().size(); ++k)
    EXPECT_EQ(method.levels()[k].frames.slot.empty(), k < hybrid.below.prolongations.size()) << k;
}

TEST(Reach, FromTwinsLeavesNoOtherWeightsAndKeepsTheirSums) {
  const DiscreteProblem<2> problem = named(plane_cases(), "circle").nested.finest();
  const std::vector<Index>& slot = problem.constraints.slot;
  const Prolongation all = levels_below(problem, {}).prolongations.back();
  Prolongation twins = all;
  reach_from_twins(slot, twins);
  ASSERT_EQ(twins.fine(), all.fine());
  Index taken_out = 0;
  for (Index p = 0; p < all.fine(); ++p) {
    double before = 0, after = 0;
    for (Offset k = all.row[p]; k < all.row[p + 1]; ++k) before += all.weight[k];
    for (Offset k = twins.row[p]; k < twins.row[p + 1]; ++k) {
      after += twins.weight[k];
      EXPECT_TRUE(slot[p] < 0 || slot[all.twin[twins.column[k]]] >= 0);
    }
    const auto fewer = (all.row[p + 1] - all.row[p]) - (twins.row[p + 1] - twins.row[p]);
    taken_out += fewer > 0;
    EXPECT_TRUE(slot[p] >= 0 || fewer == 0);
    EXPECT_NEAR(after, twins.row[p + 1] > twins.row[p] ? before : 0, 1e-14);
  }
  EXPECT_GT(taken_out, 0) << "nothing tested";
}

TEST(Reach, FromTwinsBoundsCoarseTwinsOfConstrainedVectorsAlone) {
  const DiscreteProblem<2> problem = named(plane_cases(), "circle").nested.finest();
  SolverOptions options;
  for (const char* reach : {"all", "twins"}) {
    options.reach = reach;
    const auto P = levels_below(problem, options).prolongations;
    const MonotoneMultigrid<2> method(problem, P, components_of<2>(options, registry()), settings_of<2>(options));
    const Level<2>&fine = method.levels().back(), &coarse = method.levels()[method.levels().size() - 2];
    Index others = 0;
    for (const Index q : coarse.constraints.vector) others += fine.constraints.slot[P.back().twin[q]] < 0;
    EXPECT_EQ(others > 0, options.reach == "all");
  }
}

TEST(Interpolate, LocalActsOnTheComponentsOfTheLocalBases) {
  const DiscreteProblem<2> problem = named(plane_cases(), "circle").nested.finest();
  ASSERT_FALSE(problem.frames.slot.empty());
  SolverOptions options;
  options.interpolate = "local";
  const AlgebraicLevels<2> levels = levels_below(problem, options);
  const Prolongation& P = levels.prolongations.back();
  const GalerkinMatrix<2>& coarse = levels.matrices.back();
  std::vector<double> c(Offset{P.coarse} * 2), x(problem.b.size(), 0.0), Ac(c.size()), Ax(x.size());
  for (std::size_t i = 0; i < c.size(); ++i)
    c[i] = coarse.off[i / 2] >> (i % 2) & 1u ? 0 : std::sin(3.0 * static_cast<double>(i));
  for (Index p = 0; p < P.fine(); ++p)
    for (int i = 0; i < 2; ++i)
      for (Offset k = P.row[p]; k < P.row[p + 1] && !(problem.fixed[p] >> i & 1u); ++k)
        x[p * 2 + i] += P.weight[k] * c[P.column[k] * 2 + i];
  product<2>(coarse.A, c.data(), Ac.data());
  product<2>(problem.A, x.data(), Ax.data());
  const double energy = vector(x).dot(vector(Ax));
  EXPECT_NEAR(vector(c).dot(vector(Ac)), energy, 1e-12 * energy);
}

TEST(BlackBoxOptions, AllSolveASequenceOfBounds) {
  const Given<1> given(named(scalar_cases(), "hill").nested.finest());
  std::vector<double> on_some = given.lower;  // bounds on a part, as those of a contact boundary
  for (std::size_t i = 0; i < on_some.size(); ++i)
    if (i % 3) on_some[i] = -infinity;
  for (const Choice& choice : {Choice{false, "all", "global", "all", "auto"},
                               {true, "twins", "global", "all", "auto"},
                               {false, "twins", "global", "all", "tnnmg"}}) {
    BlackBox solver(given.A, 1, options_of(choice)), usual(given.A);
    for (const auto& lower : {given.lower, on_some}) {
      const auto result = solver.solve(given.b, lower), expected = usual.solve(given.b, lower);
      EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
      EXPECT_LE((vector(result.x) - vector(expected.x)).norm(), 1e-6 * vector(expected.x).norm());
    }
  }
}

TEST(BlackBoxOptions, UnknownValuesAreRefused) {
  for (const char* key : {"reach", "interpolate"}) {
    SolverOptions options;
    (std::string(key) == "reach" ? options.reach : options.interpolate) = "some";
    try {
      const BlackBox solver(laplacian(8), 1, options);
      FAIL() << key;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input);
      EXPECT_THAT(error.what(), testing::HasSubstr(fmt::format("solver.{}: found 'some'", key)));
    }
  }
}

}  // namespace
}  // namespace signorini::test
