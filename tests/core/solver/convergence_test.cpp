// Every setting solves every problem: the energy falls in each cycle, and the result is that of the reference solver.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/solver/multigrid.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

struct Setting {
  std::string name;
  SolverOptions options;
};

std::vector<Setting> settings() {
  std::vector<Setting> out;
  const auto add = [&](const std::string& name, auto&& change) {
    SolverOptions o;
    o.tolerance = 1e-9;
    o.max_iterations = 1000;  // without truncation convergence is slow near the free boundary
    change(o);
    out.push_back({name, o});
  };
  using O = SolverOptions;
  add("default", [](O&) {});
  add("monotone", [](O& o) { o.method = "monotone"; });
  for (const char* cycle : {"W", "F"}) add(cycle, [=](O& o) { o.cycle = cycle; });
  for (const char* cycle : {"V", "W"})
    add(std::string("tnnmg ") + cycle, [=](O& o) { o.method = "tnnmg", o.cycle = cycle; });
  add("tnnmg, tangential", [](O& o) { o.method = "tnnmg", o.truncate = "tangential"; });
  add("pgs", [](O& o) { o.method = "pgs"; });
  add("tangential", [](O& o) { o.truncate = "tangential"; });
  for (const double cut : {0.1, 1.0}) add(fmt::format("cut {}", cut), [=](O& o) { o.cut = cut; });
  for (const char* smoother : {"forward", "backward", "symmetric", "surface_first", "patch"})
    add(smoother, [=](O& o) { o.smoother = smoother; });
  add("V22 symmetric", [](O& o) { o.smoother = "symmetric", o.pre = o.post = 2; });
  for (const double factor : {0.7, 1.0, 1.8})
    add(fmt::format("relaxation {}", factor), [=](O& o) { o.relaxation = factor; });
  add("no pre", [](O& o) { o.pre = 0; });
  add("no post", [](O& o) { o.post = 0; });
  add("not truncated", [](O& o) { o.truncate = "none"; });
  add("not truncated W", [](O& o) { o.truncate = "none", o.cycle = "W"; });
  for (const char* transfer : {"mandel", "kornhuber"}) {
    add(transfer, [=](O& o) { o.transfer = transfer; });
    add(fmt::format("{}, not truncated", transfer), [=](O& o) { o.transfer = transfer, o.truncate = "none"; });
  }
  add("coarse pgs", [](O& o) { o.coarse = "pgs"; });
  for (const char* rotate : {"none", "not_coarsest"}) {
    add(std::string("rotate ") + rotate, [=](O& o) { o.rotate = rotate; });
    add(std::string("not truncated, rotate ") + rotate, [=](O& o) { o.rotate = rotate, o.truncate = "none"; });
  }
  return out;
}

template <int B>
void expect_solved(const Case<B>& c) {
  const DiscreteProblem<B>& problem = c.nested.finest();
  const Reference exact = reference(problem);
  const double size = std::max(solution_norm(c.nested, exact.x), 1e-14 * exact.x.norm());
  const bool scalar_without_frames = B == 1;
  for (const Setting& s : settings()) {
    if (scalar_without_frames && s.name.find("rotate") != std::string::npos) continue;
    std::vector<double> x;
    double last = infinity, scale = problem.prescribed_energy;  // what the energies are computed from
    const Summary summary = solve_from_zero(c.nested, x, s.options, [&](const IterationRecord& r) {
      scale = std::max(scale, std::abs(r.energy));
      EXPECT_LE(r.energy, last + 1e-13 * scale) << c.name << ", " << s.name << ", cycle " << r.iteration;
      last = r.energy;
      return true;
    });
    EXPECT_TRUE(summary.converged()) << c.name << ", " << s.name << ": " << summary.reason;
    const double error = energy_norm<B>(problem.A, vector(x) - exact.x);
    EXPECT_LE(error, 1e-8 * size) << c.name << ", " << s.name << ", " << summary.iterations << " cycles";
    EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm()) << c.name << ", " << s.name;
  }
}

TEST(Convergence, ScalarProblemsToTheReferenceSolution) {
  for (const auto& c : scalar_cases()) expect_solved(c);
}
TEST(Convergence, PlaneElasticityToTheReferenceSolution) {
  for (const auto& c : plane_cases()) expect_solved(c);
}
TEST(Convergence, SpatialElasticityToTheReferenceSolution) {
  for (const auto& c : space_cases()) expect_solved(c);
}

// The coincidence set is that of the reference wherever it is not degenerate.
template <int B>
void expect_same_contact(const Case<B>& c) {
  if (c.name.find("biactive") != std::string::npos) return;
  const DiscreteProblem<B>& problem = c.nested.finest();
  const Reference exact = reference(problem);
  std::vector<double> x;
  solve_from_zero(c.nested, x);
  for (Index slot = 0; slot < problem.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Index i = problem.constraints.vector[slot] * B + k;
      if (problem.fixed[i / B] >> k & 1) continue;
      const bool contact =
          x[i] == problem.constraints.lower[slot * B + k] || x[i] == problem.constraints.upper[slot * B + k];
      EXPECT_EQ(contact, exact.state[i] == 1 || exact.state[i] == -1) << c.name << ", unknown " << i;
    }
}

TEST(Convergence, FindsTheSameCoincidenceSet) {
  for (const auto& c : scalar_cases()) expect_same_contact(c);
  for (const auto& c : plane_cases()) expect_same_contact(c);
  for (const auto& c : space_cases()) expect_same_contact(c);
}

// An obstacle that is never reached costs what a linear problem costs.
TEST(Convergence, WithoutContactIsALinearSolve) {
  const auto bounds = [](double c) { return [c](const double*) { return c; }; };
  const auto bounded = discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(1, bounds(-1), bounds(1)));
  const auto linear = discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(1, {}, {}));
  std::vector<double> x, y;
  const Summary with = solve_from_zero(bounded, x), without = solve_from_zero(linear, y);
  EXPECT_EQ(with.iterations, without.iterations);
  EXPECT_LE((vector(x) - vector(y)).norm(), 1e-8 * vector(y).norm());
  for (const IterationRecord& r : with.history) {
    EXPECT_EQ(r.changed, 0);
    EXPECT_EQ(r.contact_nodes, 0);
  }
  EXPECT_EQ(with.linear_phase_from, 1);
}

TEST(Convergence, WithoutContactAssemblesCoarseRowsOnce) {
  const auto bounds = [](double c) { return [c](const double*) { return c; }; };
  const auto p = discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(1, bounds(-1), bounds(1)));
  MonotoneMultigrid<1> method(p.finest(), p.prolongations,
                              {registry().create<Smoother<1>>("smoother", "adjoint"),
                               [] { return registry().create<Transfer<1>>("transfer", "min_merge"); },
                               registry().create<CoarseSolver<1>>("coarse", "newton")},
                              {});
  std::vector<double> x(p.finest().b.size(), 0.0);
  Index rows = 0;
  for (std::size_t k = 0; k + 1 < p.levels.size(); ++k) rows += p.levels[k].A.size();
  EXPECT_EQ(method.cycle(x.data()).renewed(), rows);
  for (int cycle = 0; cycle < 5; ++cycle) EXPECT_EQ(method.cycle(x.data()).renewed(), 0);
}

}  // namespace
}  // namespace signorini::test
