#include "apps/bench/variants.hpp"

#include <fmt/format.h>

#include "apps/bench/problems.hpp"

namespace signorini::bench {
namespace {

using Overrides = std::vector<std::string>;

struct Variant {
  const char* name;
  Overrides overrides;
};

const std::vector<Variant> variants{
    {"default", {}},
    {"without acceleration", {"solver.krylov=false"}},
    {"not truncated", {"solver.truncate=none", "solver.krylov=false"}},
    {"truncated, also tangentially", {"solver.truncate=tangential", "solver.krylov=false"}},
    {"cut 0.1", {"solver.cut=0.1", "solver.krylov=false"}},
    {"cut 1", {"solver.cut=1", "solver.krylov=false"}},
    {"W-cycle", {"solver.cycle=W", "solver.krylov=false"}},
    {"F-cycle", {"solver.cycle=F", "solver.krylov=false"}},
    {"symmetric smoothing", {"solver.smoother=symmetric", "solver.krylov=false"}},
    {"tnnmg", {"solver.method=tnnmg", "solver.krylov=false"}},
    {"tnnmg with acceleration", {"solver.method=tnnmg"}},
};

/// Cycles, rate, and the time over that of the first variant.
template <int D, int B>
std::string entry(const char* scene, Overrides overrides, const Variant& variant, double& first) {
  overrides.insert(overrides.end(), variant.overrides.begin(), variant.overrides.end());
  const Problem problem(variant.name, scene, overrides);
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const Solved solved = solve_nonlinear<D, B>(problem, hierarchy);
  const double time = solved.times.setup + solved.times.solve;
  if (first == 0) first = time;
  return fmt::format("{}{} | {:.2f} | {:.2f}", solved.summary.iterations, solved.summary.converged() ? "" : " (limit)",
                     solved.summary.rate, time / first);
}

}  // namespace

void print_variants() {
  fmt::print(
      "\n## Variants\n\nCycles, rate, and time of set-up and solve over the default's; spiral with 261121 unknowns, "
      "ball "
      "with 38160, degenerate with 65025 from a zero start.\n\n"
      "| variant | spiral | rate | time | ball | rate | time | degenerate | rate | time |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  double spiral = 0, ball = 0, degenerate = 0;
  for (const Variant& v : variants) {
    fmt::print("| {} | {} | {} | {} |\n", v.name, entry<2, 1>("obstacle_spiral.toml", {"refine.uniform=7"}, v, spiral),
               entry<3, 3>("ball_on_plane.toml", {"refine.uniform=2"}, v, ball),
               entry<2, 1>("obstacle_degenerate.toml", {"refine.uniform=6", "solver.start=zero"}, v, degenerate));
    std::fflush(stdout);
  }
}

}  // namespace signorini::bench
