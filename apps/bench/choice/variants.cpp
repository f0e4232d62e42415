#include "apps/bench/choice/variants.hpp"

#include <fmt/format.h>

#include "apps/bench/problems.hpp"
#include "core/base/error.hpp"

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
    {"monotone", {"solver.method=monotone"}},
    {"monotone, kornhuber", {"solver.method=monotone", "solver.transfer=kornhuber"}},
    {"V(1,1)", {"solver.pre=1", "solver.post=1"}},
    {"V(3,3)", {"solver.pre=3", "solver.post=3"}},
    {"W-cycle", {"solver.cycle=W"}},
    {"F-cycle", {"solver.cycle=F"}},
    {"symmetric smoothing", {"solver.smoother=symmetric"}},
    {"surface first", {"solver.smoother=surface_first"}},
    {"patches", {"solver.smoother=patch"}},
    {"primal-dual active sets", {"solver.method=pdas"}},
};

/// Every cycle on its own, until the rate has settled.
const Overrides plain{"solver.krylov=false", "solver.tolerance=1e-10", "solver.start=zero",
                      "solver.max_iterations=400"};

const std::vector<Variant> restrictions{
    {"min_merge", {}},
    {"mandel", {"solver.transfer=mandel"}},
    {"kornhuber", {"solver.transfer=kornhuber"}},
    {"min_merge, not truncated", {"solver.truncate=none"}},
    {"mandel, not truncated", {"solver.transfer=mandel", "solver.truncate=none"}},
    {"kornhuber, not truncated", {"solver.transfer=kornhuber", "solver.truncate=none"}},
    {"min_merge, truncated also tangentially", {"solver.truncate=tangential"}},
    {"min_merge, cut 0.01", {"solver.cut=0.01"}},
    {"min_merge, cut 0.1", {"solver.cut=0.1"}},
    {"min_merge, cut 1", {"solver.cut=1"}},
    {"kornhuber, cut 0.1", {"solver.transfer=kornhuber", "solver.cut=0.1"}},
    {"tnnmg", {"solver.method=tnnmg"}},
    {"tnnmg, cut 0.1", {"solver.method=tnnmg", "solver.cut=0.1"}},
    {"tnnmg, truncated also tangentially", {"solver.method=tnnmg", "solver.truncate=tangential"}},
};

/// On algebraic levels.
const std::vector<Variant> algebraic{
    {"default", {}},
    {"reassemble = false", {"solver.reassemble=false"}},
    {"reach = \"twins\"", {"solver.reach=twins"}},
    {"reach = \"twins\", reassemble = false", {"solver.reach=twins", "solver.reassemble=false"}},
    {"interpolate = \"local\"", {"solver.interpolate=local"}},
    {"rotate = \"meshes\"", {"solver.rotate=meshes"}},
    {"start = \"zero\"", {"solver.start=zero"}},
    {"krylov = false", {"solver.krylov=false"}},
    {"method = \"tnnmg\"", {"solver.method=tnnmg"}},
    {"method = \"tnnmg\", krylov = false", {"solver.method=tnnmg", "solver.krylov=false"}},
};

struct Solve {
  Summary summary;
  double seconds = 0;  ///< set-up and solve
};

template <int D, int B>
Solve outcome(const char* scene, Overrides overrides, const Overrides& further) {
  overrides.insert(overrides.end(), further.begin(), further.end());
  const Problem problem(scene, scene, overrides);
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const Solved solved = solve_nonlinear<D, B>(problem, hierarchy);
  return {solved.summary, solved.times.setup + solved.times.solve};
}

std::string cycles(const Summary& summary) {
  return fmt::format("{}{} | {:.2f}", summary.iterations, summary.converged() ? "" : " (limit)", summary.rate);
}

/// Cycles, rate, and the time over that of the first variant.
std::string timed(const Solve& outcome, double& first) {
  if (first == 0) first = outcome.seconds;
  return fmt::format("{} | {:.2f}", cycles(outcome.summary), outcome.seconds / first);
}

void print_times() {
  fmt::print(
      "\n## Variants\n\nCycles, rate, and time of set-up and solve over the default's; spiral with 261121 unknowns, "
      "ball with 38160, degenerate with 65025 from a zero start.\n\n"
      "| variant | spiral | rate | time | ball | rate | time | degenerate | rate | time |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  double spiral = 0, ball = 0, degenerate = 0;
  for (const Variant& v : variants) {
    fmt::print("| {} | {} | {} | {} |\n", v.name,
               timed(outcome<2, 1>("obstacle_spiral.toml", {"refine.uniform=7"}, v.overrides), spiral),
               timed(outcome<3, 3>("ball_on_plane.toml", {"refine.uniform=2"}, v.overrides), ball),
               timed(outcome<2, 1>("obstacle_degenerate.toml", {"refine.uniform=6", "solver.start=zero"}, v.overrides),
                     degenerate));
    std::fflush(stdout);
  }
}

void print_rates() {
  fmt::print(
      "\n## Truncation, restriction, cut\n\nCycles from a zero start to 1e-10 and asymptotic rates, without "
      "acceleration, method monotone unless a row says otherwise; spiral with 65025 unknowns, ball with 38160, "
      "degenerate with 65025.\n\n"
      "| variant | spiral | rate | ball | rate | degenerate | rate |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Variant& v : restrictions) {
    const auto with_plain = [](Overrides overrides) {
      overrides.push_back("solver.method=monotone");
      overrides.insert(overrides.end(), plain.begin(), plain.end());
      return overrides;
    };
    fmt::print(
        "| {} | {} | {} | {} |\n", v.name,
        cycles(outcome<2, 1>("obstacle_spiral.toml", with_plain({"refine.uniform=6"}), v.overrides).summary),
        cycles(outcome<3, 3>("ball_on_plane.toml", with_plain({"refine.uniform=2"}), v.overrides).summary),
        cycles(outcome<2, 1>("obstacle_degenerate.toml", with_plain({"refine.uniform=6"}), v.overrides).summary));
    std::fflush(stdout);
  }
}

void print_algebraic_levels() {
  const Overrides unrefined{"refine.uniform=0", "solver.method=monotone", "solver.coarsening=classical"};
  const auto with = [&](Overrides overrides) {
    overrides.insert(overrides.end(), unrefined.begin(), unrefined.end());
    return overrides;
  };
  const Overrides s2 = with({"body.0.cells=[256, 256]"}), s3 = with({"body.0.cells=[32, 32, 32]"}),
                  e3 = with({"body.0.cells=[16, 16, 16]"}), ball = with({"body.0.size=0.08"}),
                  bed = with({"body.0.size=0.01", "steps.count=1"});
  fmt::print(
      "\n## Algebraic levels\n\nUnrefined meshes: cycles and rates; method monotone unless a row says otherwise. "
      "S2 with 257, S3 with 33, E3 with 17 nodes along an edge, half ball and half disk with edges of 0.08 and "
      "0.01.\n\n"
      "| variant | S2 | rate | S3 | rate | E3 | rate | ball on plane | rate | disk in bed | rate |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Variant& v : algebraic) {
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", v.name,
               cycles(outcome<2, 1>("obstacle_radial_2d.toml", s2, v.overrides).summary),
               cycles(outcome<3, 1>("obstacle_cube_3d.toml", s3, v.overrides).summary),
               cycles(outcome<3, 3>("cube_on_bump.toml", e3, v.overrides).summary),
               cycles(outcome<3, 3>("ball_on_plane.toml", ball, v.overrides).summary),
               cycles(outcome<2, 2>("disk_in_bed_steps.toml", bed, v.overrides).summary));
    std::fflush(stdout);
  }
}

template <int D, int B>
Summary summary_of(const char* scene, const Overrides& overrides) {
  return outcome<D, B>(scene, overrides, {}).summary;
}

struct Column {
  const char* name;
  const char* scene;
  Summary (*solve)(const char* scene, const Overrides& overrides);
};

const std::vector<Column> scenes{
    {"radial 2D", "obstacle_radial_2d.toml", summary_of<2, 1>},
    {"radial 3D", "obstacle_radial_3d.toml", summary_of<3, 1>},
    {"cube 3D", "obstacle_cube_3d.toml", summary_of<3, 1>},
    {"spiral", "obstacle_spiral.toml", summary_of<2, 1>},
    {"degenerate", "obstacle_degenerate.toml", summary_of<2, 1>},
    {"torsion", "obstacle_torsion_disk.toml", summary_of<2, 1>},
    {"Signorini 2D", "signorini_elastic_2d.toml", summary_of<2, 2>},
    {"cylinder", "cylinder_on_plane_2d.toml", summary_of<2, 2>},
    {"disk in bed", "disk_in_bed_steps.toml", summary_of<2, 2>},
    {"punch", "punch.toml", summary_of<3, 3>},
    {"ball", "ball_on_plane.toml", summary_of<3, 3>},
    {"cube on bump", "cube_on_bump.toml", summary_of<3, 3>},
    {"block", "block_on_surface.toml", summary_of<3, 3>},
};

std::string cycles_on(const Column& column, const Overrides& overrides) {
  try {
    const Summary summary = column.solve(column.scene, overrides);
    return fmt::format("{}{}", summary.iterations, summary.converged() ? "" : " (not converged)");
  } catch (const Error& error) {
    return error.what();
  }
}

void print_scenes() {
  fmt::print(
      "\n## All variants on all scenes\n\nCycles to 1e-8 with a nested start, scenes as they are in "
      "`apps/scenes`.\n\n| variant |");
  for (const Column& column : scenes) fmt::print(" {} |", column.name);
  fmt::print("\n| --- |");
  for (std::size_t k = 0; k < scenes.size(); ++k) fmt::print(" --- |");
  fmt::print("\n");
  std::vector<Variant> all(variants.begin(), variants.end() - 1);  // without the direct solver, which takes minutes
  all.insert(all.end(), restrictions.begin() + 1, restrictions.end());
  for (const Variant& v : all) {
    fmt::print("| {} |", v.name);
    for (const Column& column : scenes) fmt::print(" {} |", cycles_on(column, v.overrides));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

void print_variants() {
  print_scenes();
  print_times();
  print_rates();
  print_algebraic_levels();
}

}  // namespace signorini::bench
