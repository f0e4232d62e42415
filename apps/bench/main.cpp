// The figures of docs/measured/performance.md, as ratios within one run; see --help.
#include <fmt/format.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/bench/accuracy/adaptive.hpp"
#include "apps/bench/accuracy/incompressible.hpp"
#include "apps/bench/accuracy/pressures.hpp"
#include "apps/bench/accuracy/quadratic_elements.hpp"
#include "apps/bench/accuracy/tables.hpp"
#include "apps/bench/bodies/bodies.hpp"
#include "apps/bench/bodies/touching.hpp"
#include "apps/bench/choice/choice.hpp"
#include "apps/bench/choice/kept_aside.hpp"
#include "apps/bench/choice/variants.hpp"
#include "apps/bench/friction/friction_coefficients.hpp"
#include "apps/bench/friction/friction_costs.hpp"
#include "apps/bench/friction/partial_slip.hpp"
#include "apps/bench/matrices/again.hpp"
#include "apps/bench/matrices/aggregates.hpp"
#include "apps/bench/matrices/algebraic.hpp"
#include "apps/bench/matrices/fourth_order.hpp"
#include "apps/bench/matrices/quadratic_matrices.hpp"
#include "apps/bench/matrices/warm.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/ratios.hpp"
#include "apps/bench/shares/boundary.hpp"
#include "apps/bench/shares/memory.hpp"
#include "apps/bench/shares/steps.hpp"
#include "apps/bench/shares/traffic.hpp"
#include "core/base/heap.hpp"

namespace signorini::bench {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::vector<int> uniform;  // refinements, smallest problem first
  std::vector<std::string> overrides;
  std::vector<double> load;  // of the linear comparison, which without it may be trivial
};

std::vector<std::string> with(std::vector<std::string> overrides, int uniform) {
  overrides.push_back(fmt::format("refine.uniform={}", uniform));
  return overrides;
}

void row(const std::string& text) { fmt::print("{}\n", text), std::fflush(stdout); }

template <int D, int B>
void compare_with_linear(const Case& c, const Problem& problem) {
  const BesideLinear m = beside_linear<D, B>(problem, c.load);
  row(fmt::format("| {} | {:.0f} | {} | {} | {:.2f} | {:.2f} | {:.2f} |", c.name, m.nonlinear.unknowns(),
                  m.nonlinear.summary.iterations, m.linear.iterations, m.solve(), m.set_up_and_solve(), m.assembly()));
}

template <int D, int B>
void cycle_traffic(const Case& c, const Problem& problem, double bandwidth) {
  const CycleTraffic m = cycle_traffic<D, B>(problem, bandwidth);
  row(fmt::format("| {} | {} | {:.1f} | {:.2f} |", c.name, m.unknowns, m.bytes / 1e6, m.time_over));
}

template <int D, int B>
void growth(const Case& c) {
  double first = 0;
  for (const int uniform : c.uniform) {
    const Problem problem(c.name, c.scene, with(c.overrides, uniform));
    const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
    const Solved solved = solve_nonlinear<D, B>(problem, hierarchy);
    const double each = solved.whole() / solved.unknowns();
    if (first == 0) first = each;
    row(fmt::format("| {} | {:.0f} | {} | {:.3f} | {:.2f} |", c.name, solved.unknowns(), solved.summary.iterations,
                    solved.summary.rate, each / first));
  }
}

template <int D, int B>
void largest(const Case& c, double bandwidth, bool traffic) {
  const Problem problem(c.name, c.scene, with(c.overrides, c.uniform.back()));
  if (traffic)
    cycle_traffic<D, B>(c, problem, bandwidth);
  else
    compare_with_linear<D, B>(c, problem);
}

void run(bool quick) {
  const int less = quick ? 2 : 0;
  const auto upto = [&](int from, int to) {
    std::vector<int> sizes;
    for (int k = from; k <= to - less; ++k) sizes.push_back(k);
    return sizes;
  };
  const Case radial2{"radial 2D", "obstacle_radial_2d.toml", upto(4, 8), {}, {}};
  const Case radial3{"radial 3D", "obstacle_radial_3d.toml", upto(2, 5), {}, {1.0}};
  const Case spiral{"spiral", "obstacle_spiral.toml", upto(5, 8), {}, {0.0}};
  const Case ball{"ball on plane", "ball_on_plane.toml", upto(1, 4), {}, {0, 0, -1}};
  const Case cube{"cube 3D (S3)", "obstacle_cube_3d.toml", upto(3, 5), {}, {}};
  const Case bump{"cube on bump (E3)", "cube_on_bump.toml", upto(2, 4), {}, {0, 0, -1}};
  const Case flat{"cube on flat bump (E3w)", "cube_on_bump.toml", upto(2, 4), {flat_bump}, {0, 0, -1}};
  const Case fine{"radial 2D, V(2,2) symmetric",
                  "obstacle_radial_2d.toml",
                  upto(4, 7),
                  {"solver.smoother=symmetric", "solver.pre=2", "solver.post=2"},
                  {}};
  const Case ball_fine{"ball on plane, V(2,2) symmetric",
                       "ball_on_plane.toml",
                       upto(1, 3),
                       {"solver.smoother=symmetric", "solver.pre=2", "solver.post=2"},
                       {}};
  const double bandwidth = stream_bandwidth();

  fmt::print(
      "## Nonlinear over linear\n\n| problem | unknowns | cycles | CG iterations | solve | set-up and solve | "
      "assembly |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  largest<2, 1>(radial2, bandwidth, false);
  largest<3, 1>(radial3, bandwidth, false);
  largest<3, 1>(cube, bandwidth, false);
  largest<3, 3>(ball, bandwidth, false);
  largest<3, 3>(bump, bandwidth, false);
  largest<3, 3>(flat, bandwidth, false);

  fmt::print(
      "\n## V(1,1) cycle over its memory traffic\n\nTriad: {:.1f} GB/s.\n\n| problem | unknowns | MB | time over "
      "traffic |\n| --- | --- | --- | --- |\n",
      bandwidth / 1e9);
  largest<2, 1>(radial2, bandwidth, true);
  largest<3, 1>(radial3, bandwidth, true);
  largest<3, 1>(cube, bandwidth, true);
  largest<3, 3>(ball, bandwidth, true);
  largest<3, 3>(bump, bandwidth, true);

  fmt::print(
      "\n## Iterations, rate and time per unknown as the mesh is refined\n\n| problem | unknowns | cycles | rate | "
      "time per unknown over the first row's |\n| --- | --- | --- | --- | --- |\n");
  growth<2, 1>(radial2);
  growth<2, 1>(spiral);
  growth<3, 1>(radial3);
  growth<3, 3>(ball);
  growth<2, 1>(fine);
  growth<3, 3>(ball_fine);
  print_algebraic(quick);
  print_boundary(quick);
  print_memory(quick);
}

// A good part of the memory becomes part of the heap before anything is measured: on a virtual machine the first touch
// of a page can take longer than all that is done with it, and whatever comes first would pay for what follows.
void fetch_memory() {
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t size = static_cast<std::size_t>(sysconf(_SC_AVPHYS_PAGES)) / 4 * page;
  const std::unique_ptr<volatile char[]> memory(new char[size]);
  for (std::size_t k = 0; k < size; k += page) memory[k] = 0;
}

struct Arguments {
  bool quick = false;
  std::string only;
  std::filesystem::path pictures;
};

/// What a flag asks for in place of all the rest.
struct Table {
  const char* flag;
  const char* help;
  void (*print)(const Arguments&);
};

template <void (*print)(bool)>
void sized(const Arguments& arguments) {
  print(arguments.quick);
}

constexpr const char* of_chosen = "--choice";
constexpr const char* of_kept_aside = "--kept-aside";
constexpr const char* of_accuracy = "--accuracy";

const Table tables[] = {
    {"--algebraic", "only the table of matrices without meshes", sized<print_algebraic>},
    {"--quadratic-elements", "only quadratic elements beside linear ones on as many nodes: cycles, time, traffic",
     sized<print_quadratic_elements>},
    {"--quadratic-matrices", "only matrices of quadratic elements beside those of linear ones, without meshes",
     sized<print_quadratic_matrices>},
    {"--fourth-order", "only plates, beams and programmes of CUTEst, without meshes", sized<print_fourth_order>},
    {"--boundary", "only the cost of the plugin boundary", sized<print_boundary>},
    {"--warm", "only the cycles from a solution before, for matrices without meshes", sized<print_warm>},
    {"--again", "only the cost of a second solve with other bounds", sized<print_again>},
    {"--steps", "only the cost of steps beside their cycles", sized<print_steps>},
    {"--partial-slip", "only friction against Cattaneo and Mindlin, the tables of docs/measured/friction.md",
     sized<print_partial_slip>},
    {of_accuracy, "only errors beside seconds, the tables of docs/measured/accuracy.md",
     [](const Arguments& a) { print_accuracy(a.quick, a.only, a.pictures); }},
    {"--adaptive", "only meshes that are finer where the error is, the tables of docs/measured/adaptive.md",
     sized<print_adaptive>},
    {"--pressures", "only contact pressures against Hertz, the tables of docs/measured/pressures.md",
     sized<print_pressures>},
    {"--incompressible", "only elements for nearly incompressible material, the tables of docs/measured/rubber.md",
     sized<print_incompressible>},
    {"--friction-coefficients", "only what becomes of coefficients of friction from 0 to 5",
     sized<print_friction_coefficients>},
    {"--friction-costs", "only cycles and time of steps with friction beside those without",
     sized<print_friction_costs>},
    {"--friction-scenes", "only the same on scenes of other kinds", sized<print_friction_scenes>},
    {"--friction-direct", "only friction by cycles beside Newton's method with a direct solver",
     sized<print_friction_direct>},
    {"--bodies",
     "only bodies that touch each other, as one problem and in turns, the tables of docs/measured/bodies.md",
     sized<print_bodies>},
    {"--memory", "only the peak memory of a solve", sized<print_memory>},
    {"--touching", "only the costs of bodies in contact with each other, a table of docs/measured/bodies.md",
     sized<print_touching>},
    {"--variants", "only the tables of docs/measured/variants.md",
     [](const Arguments&) { print_variants(), print_aggregates(); }},
    {"--aggregates", "of these, only the table of aggregates", [](const Arguments&) { print_aggregates(); }},
    {of_chosen, "only the default settings over the best picked by hand",
     [](const Arguments& a) { print_choice(a.only); }},
    {of_kept_aside, "only the same on problems on which nothing was chosen",
     [](const Arguments& a) { print_kept_aside_scenes(a.only), print_kept_aside_matrices(a.only); }}};

void print(const CLI::App& app, const Arguments& arguments) {
  bool all = true;
  for (const Table& table : tables)
    if (app.count(table.flag) > 0) table.print(arguments), all = false;
  if (all) run(arguments.quick);
}

}  // namespace
}  // namespace signorini::bench

int main(int argc, char** argv) {
  namespace bench = signorini::bench;
  CLI::App app(
      "The figures of docs/measured/performance.md as tables in Markdown: ratios of times within one run, one thread.");
  bench::Arguments arguments;
  app.add_flag("--quick", arguments.quick, "leave out the largest sizes");
  for (const bench::Table& table : bench::tables) app.add_flag(table.flag, table.help);
  app.add_option("--only", arguments.only, "of these, problems with this text in their names")
      ->check([&](const std::string&) {
        for (const char* flag : {bench::of_chosen, bench::of_kept_aside, bench::of_accuracy})
          if (app.count(flag) > 0) return "";
        return "needs --choice, --kept-aside or --accuracy";
      });
  app.add_option("--pictures", arguments.pictures, "a folder for the pictures of --accuracy")
      ->check(CLI::ExistingDirectory);
  app.footer("Exit status: 0 measured, 1 wrong usage, 2 a benchmark failed");
  try {
    app.parse(argc, argv);
    signorini::keep_freed_memory();
    bench::fetch_memory();
    bench::print(app, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "signorini_bench: error: {}\n", error.what());
    return 2;
  }
}
