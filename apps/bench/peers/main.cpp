// Solvers of others on the benchmark problems, each until its answer is accurate enough, as ratios within one run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <set>

#include "apps/bench/peers/calculix.hpp"
#include "apps/bench/peers/calculix_bodies.hpp"
#include "apps/bench/peers/quadratic_ball.hpp"
#include "apps/bench/peers/run.hpp"
#include "apps/bench/peers/setup.hpp"
#include "apps/bench/peers/solvers.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

struct Arguments {
  std::vector<std::string> problems{"S2", "S3", "E3", "E3w"};
  std::vector<int> nodes;
  std::string only;
  Patience patience;
  bool setup = false, ball = false, calculix = false, calculix_bodies = false, quick = false;
  std::string matrix;
};

const std::map<std::string, int> default_nodes{{"S2", 257}, {"S3", 33}, {"E3", 17}, {"E3w", 17}};

/// Names of solvers that took too long on a problem; larger sizes of it are not tried.
using Slow = std::set<std::string>;

const char* given(const Contestant& c) {
  if (!c.bounded) return c.given == Given::meshes ? "no bounds" : "matrix, no bounds";
  return c.given == Given::meshes ? "meshes" : "matrix, bounds";
}

std::string row(const Contestant& c, const Measurement& m, double ours) {
  const std::string head = fmt::format("| {} | {} |", c.name, given(c));
  if (!m.solved()) return fmt::format("{} {} | | | | |", head, m.failure);
  return fmt::format("{} {:.3f} | {} | {} | {:.1e} | {:.1e} |", head, m.attempt.seconds,
                     ours > 0 ? fmt::format("{:.2f}", m.attempt.seconds / ours) : "", m.attempt.iterations, m.error,
                     m.residual);
}

std::string identity(const Contestant& c) { return fmt::format("{} ({})", c.name, given(c)); }

/// @returns whether all solvers that ran in time were accurate
bool compare(const std::string& name, int nodes, const Arguments& arguments, Slow& slow) {
  const Benchmark benchmark = make_benchmark(name, nodes);
  const Instance& instance = benchmark.instance;
  fmt::print(
      "\n## {}, {} nodes along an edge: {} unknowns, {} nonzeros\n\nAssembly of all levels: {:.3f} s, part of no time "
      "below.\n\n| solver | given | seconds | ratio | iterations | error | residual |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n",
      name, nodes, instance.finest().b.size(), instance.finest().A.value.size(), benchmark.assembly);
  std::set<Given> seen;
  std::map<Given, double> ours;
  bool good = true;
  for (const Contestant& c : contestants(name, benchmark)) {
    const bool own = c.bounded && seen.insert(c.given).second;
    if (!own && c.name.find(arguments.only) == std::string::npos) continue;
    Measurement m;
    if (slow.contains(identity(c))) {
      m.failure = "not run";
    } else {
      const QuadraticProgram program = c.bounded ? bounded(instance.finest()) : unbounded(instance);
      m = measure(c.solve, program, c.bounded ? benchmark.bounded : benchmark.unbounded, arguments.patience);
      if (m.too_slow) slow.insert(identity(c));
      good = good && (m.solved() || m.too_slow);
    }
    if (own && m.solved()) ours[c.given] = m.attempt.seconds;
    fmt::print("{}\n", row(c, m, ours[c.given]));
    std::fflush(stdout);
  }
  return good;
}

bool run(const Arguments& arguments) {
  bool good = true;
  for (const std::string& name : arguments.problems) {
    Slow slow;
    std::vector<int> nodes = arguments.nodes;
    if (nodes.empty())
      if (const auto found = default_nodes.find(name); found != default_nodes.end()) nodes = {found->second};
    std::sort(nodes.begin(), nodes.end());
    for (const int n : nodes) good = compare(name, n, arguments, slow) && good;
  }
  return good;
}

/// What flags ask for in place of the benchmark problems. False where there are none.
bool print_other(const Arguments& arguments) {
  if (arguments.setup) print_setup(arguments.quick, arguments.matrix);
  if (arguments.ball) print_quadratic_ball(arguments.quick, arguments.only);
  if (arguments.calculix) print_calculix(arguments.quick);
  if (arguments.calculix_bodies) print_calculix_bodies(arguments.quick);
  return arguments.setup || arguments.ball || arguments.calculix || arguments.calculix_bodies;
}

int run_program(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Solvers of others on the benchmark problems: tables in Markdown. Each solver runs with tighter and tighter "
      "tolerances until the relative error in the energy norm is at most 1e-6 and the natural residual at most 1e-8 of "
      "its value at the projected zero; the last run counts, set-up included, assembly not.");
  app.add_option("--problem", arguments.problems, "S2, S3, E3 or E3w; several")
      ->check(CLI::IsMember({"S2", "S3", "E3", "E3w"}))
      ->capture_default_str();
  app.add_option("--nodes", arguments.nodes,
                 "vertices along an edge, odd; several; default: 257 for S2, 33 for S3, 17 for E3 and E3w");
  app.add_option("--solver", arguments.only, "only solvers with this text in their names, and this project's own");
  app.add_option("--limit", arguments.patience.seconds,
                 "seconds of all its tolerances together after which a solver is given up; that solver is not run on "
                 "larger sizes of the problem")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--repeat", arguments.patience.repeats, "runs of solvers that take less than 10 s; the best counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--setup", arguments.setup, "only the set-up of algebraic hierarchies, without bounds");
  app.add_option("--matrix", arguments.matrix, "only matrices of that with this text in their names");
  app.add_flag("--ball", arguments.ball,
               "only the ball of quadratic elements beside CalculiX and GetFEM, a table of docs/measured/accuracy.md");
  app.add_flag("--calculix", arguments.calculix, "only friction beside CalculiX");
  app.add_flag("--calculix-bodies", arguments.calculix_bodies, "only two bodies beside CalculiX");
  app.add_flag("--quick", arguments.quick, "small sizes of --setup, --ball, --calculix and --calculix-bodies");
  app.footer(
      "Set OMP_NUM_THREADS=1, as ./dev bench peers does: else the threads of OpenBLAS count as processor time of "
      "CHOLMOD "
      "and IPOPT.\n"
      "Exit status: 0 all solvers that were in time were accurate, 1 wrong usage, 2 bad input, 3 otherwise");
  try {
    app.parse(argc, argv);
    if (print_other(arguments)) return 0;
    return run(arguments) ? 0 : 3;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "signorini_peers: error: {}\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "signorini_peers: error: {}\n", error.what());
    return 2;
  }
}

}  // namespace
}  // namespace signorini::bench

int main(int argc, char** argv) { return signorini::bench::run_program(argc, argv); }
