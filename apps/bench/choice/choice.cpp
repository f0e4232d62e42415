#include "apps/bench/choice/choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/choice/kept_aside.hpp"
#include "apps/bench/comparison.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/processor_time.hpp"

namespace signorini::bench {
namespace {

// What may be picked by hand: every method with every list of steps and the other parts, as far as it converges.
const std::vector<Overrides> methods{{"solver.method=monotone"},
                                     {"solver.method=tnnmg"},
                                     {"solver.method=monotone", "solver.transfer=kornhuber"},
                                     {"solver.method=monotone", "solver.transfer=mandel"},
                                     {"solver.method=pdas"}};
const std::vector<Overrides> steps{{},
                                   {"solver.pre=1", "solver.post=1"},
                                   {"solver.pre=1", "solver.post=2"},
                                   {"solver.pre=2", "solver.post=3"},
                                   {"solver.pre=3", "solver.post=3"},
                                   {"solver.pre=4", "solver.post=4"},
                                   {"solver.cycle=W"},
                                   {"solver.cycle=F"},
                                   {"solver.coarse=pgs"},
                                   {"solver.relaxation=1.1"},
                                   {"solver.relaxation=1.3"},
                                   {"solver.smoother=surface_first"},
                                   {"solver.smoother=symmetric", "solver.pre=1", "solver.post=1"},
                                   {"solver.cut=0.1"},
                                   {"solver.krylov=false"}};
const Overrides tangential{"solver.truncate=tangential"}, patches{"solver.smoother=patch"};
const std::vector<Overrides> coarsenings{{"solver.coarsening=classical"}, {"solver.coarsening=aggregation"}};

constexpr Offset small = 50000;  // unknowns, above which patches and factorisations take many times a sweep

struct Case {
  const char* name;
  const char* scene;
  Overrides overrides;
  bool kept_aside = false;
};

/// The settings of one problem.
template <int D, int B>
class Choice {
 public:
  explicit Choice(const Case& c)
      : case_(c), given_(c.name, c.scene, c.overrides), hierarchy_(build_hierarchy<D>(given_.scene, B)) {
    assembly_ = assembly_seconds<D, B>(build_model<B>(given_.scene, D, given_.registry, 1), hierarchy_);
  }

  void print() const {
    Comparison comparison([this](const Overrides& settings) { return run(settings); });
    for (const Overrides& method : case_.kept_aside ? kept_aside::methods : methods)
      if (method.front() != "solver.method=pdas")
        comparison.try_method(method, lists());
      else if (unknowns() <= small)
        comparison.try_method(method, {});
    comparison.confirm();
    fmt::print("| {} | {} | {} |\n", case_.name, unknowns(), comparison.row());
    std::fflush(stdout);
  }

 private:
  Offset unknowns() const { return Offset{hierarchy_.finest().vertices()} * B; }

  std::vector<Overrides> lists() const {
    if (case_.kept_aside) return kept_aside::lists;
    std::vector<Overrides> all = steps;
    if (B > 1) all.push_back(tangential);
    if (unknowns() <= small) all.push_back(patches);
    if (B > 1 && hierarchy_.levels.size() == 1) all.insert(all.end(), coarsenings.begin(), coarsenings.end());
    return all;
  }

  Trial run(const Overrides& settings) const {
    const Problem problem(case_.name, case_.scene, joined(case_.overrides, settings));
    const ProcessorTime time;
    const Solved solved = solve_nonlinear<D, B>(problem, hierarchy_);
    return {solved.summary.iterations, solved.summary.converged(), time.elapsed() - assembly_};
  }

  Case case_;
  Problem given_;
  MeshHierarchy<D> hierarchy_;
  double assembly_ = 0;
};

template <int D, int B>
void print_case(const Case& c) {
  Choice<D, B>(c).print();
}

struct Row {
  Case given;
  void (*print)(const Case&);
};

void print_rows(const std::vector<Row>& rows, const std::string& only) {
  fmt::print(
      "| problem | unknowns | cycles | best | its cycles | failed | default over best |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Row& row : rows)
    if (std::string(row.given.name).find(only) != std::string::npos) row.print(row.given);
}

}  // namespace

void print_choice(const std::string& only) {
  fmt::print("\n## Default over the best picked by hand\n\n");
  const auto refined = [](int k) { return fmt::format("refine.uniform={}", k); };
  const std::string zero = "solver.start=zero";
  const std::vector<Row> rows{
      {{"radial 2D (S2)", "obstacle_radial_2d.toml", {refined(5)}}, print_case<2, 1>},
      {{"radial 2D (S2), zero start", "obstacle_radial_2d.toml", {refined(5), zero}}, print_case<2, 1>},
      {{"radial 3D", "obstacle_radial_3d.toml", {refined(3)}}, print_case<3, 1>},
      {{"cube 3D (S3)", "obstacle_cube_3d.toml", {refined(4)}}, print_case<3, 1>},
      {{"spiral", "obstacle_spiral.toml", {refined(6)}}, print_case<2, 1>},
      {{"degenerate", "obstacle_degenerate.toml", {refined(6)}}, print_case<2, 1>},
      {{"degenerate, zero start", "obstacle_degenerate.toml", {refined(6), zero}}, print_case<2, 1>},
      {{"torsion", "obstacle_torsion_disk.toml", {refined(5)}}, print_case<2, 1>},
      {{"elastic 2D", "signorini_elastic_2d.toml", {refined(6)}}, print_case<2, 2>},
      {{"cylinder on plane", "cylinder_on_plane_2d.toml", {refined(4)}}, print_case<2, 2>},
      {{"disk in bed", "disk_in_bed_steps.toml", {refined(5)}}, print_case<2, 2>},
      {{"ball on plane", "ball_on_plane.toml", {refined(2)}}, print_case<3, 3>},
      {{"ball on plane, zero start", "ball_on_plane.toml", {refined(2), zero}}, print_case<3, 3>},
      {{"cube on bump (E3)", "cube_on_bump.toml", {refined(3)}}, print_case<3, 3>},
      {{"cube on flat bump (E3w)", "cube_on_bump.toml", {refined(3), flat_bump}}, print_case<3, 3>},
      {{"block on surface", "block_on_surface.toml", {refined(3)}}, print_case<3, 3>},
      {{"punch", "punch.toml", {refined(3)}}, print_case<3, 3>},
      {{"cylinder, not refined", "cylinder_on_plane_2d.toml", {refined(0), "body.0.size=0.02"}}, print_case<2, 2>},
      {{"ball, not refined", "ball_on_plane.toml", {refined(0), "body.0.size=0.08"}}, print_case<3, 3>},
  };
  print_rows(rows, only);
}

void print_kept_aside_scenes(const std::string& only) {
  fmt::print("\n## Scenes kept aside\n\n");
  const std::vector<Row> rows{
      {{"bracket", "../bench/choice/kept_aside/bracket.toml", {}, true}, print_case<2, 1>},
      {{"wedge", "../bench/choice/kept_aside/wedge.toml", {}, true}, print_case<2, 1>},
      {{"tray", "../bench/choice/kept_aside/tray.toml", {}, true}, print_case<3, 1>},
      {{"drum", "../bench/choice/kept_aside/drum.toml", {}, true}, print_case<3, 1>},
      {{"star", "../bench/choice/kept_aside/star.toml", {}, true}, print_case<2, 2>},
      {{"tyre", "../bench/choice/kept_aside/tyre.toml", {}, true}, print_case<2, 2>},
      {{"seal", "../bench/choice/kept_aside/seal.toml", {}, true}, print_case<2, 2>},
      {{"roller", "../bench/choice/kept_aside/roller.toml", {}, true}, print_case<3, 3>},
      {{"cap", "../bench/choice/kept_aside/cap.toml", {}, true}, print_case<3, 3>},
      {{"groove", "../bench/choice/kept_aside/groove.toml", {}, true}, print_case<3, 3>},
  };
  print_rows(rows, only);
}

}  // namespace signorini::bench
