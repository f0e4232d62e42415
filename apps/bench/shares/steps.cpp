#include "apps/bench/shares/steps.hpp"

#include <fmt/format.h>

#include <vector>

#include "apps/scenes/tables.hpp"
#include "core/base/stopwatch.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

// An oblique plane rises against a block that is held at its top: the contact grows in every step.
const std::string block =
    tables::block("block", "[0, 0, 0]", "[1, 1, 1.25]", "[4, 4, 5]") + tables::fix("block", "top", "[0, 0, 0]") +
    tables::plane("block", "bottom", "[0.5, 0.5, '-0.04 + 0.08 * t']", "[0.1, 0, 1]") + "[steps]\ncount = 20\n";

}  // namespace

void print_steps(bool quick) {
  Driver driver(
      parse_scene(block, "block.toml", ".", std::vector<std::string>{quick ? "refine.uniform=3" : "refine.uniform=4"}));
  fmt::print(
      "## Steps of a moving plane\n\n| step | unknowns | cycles | step over its cycles |\n| --- | --- | --- | --- |\n");
  double steps = 0, cycles = 0, before = 0;
  Stopwatch watch;
  driver.solve([&] {
    const Report& report = driver.report();
    const double step = watch.lap(), own = report.time.solve - before;
    before = report.time.solve;
    if (report.steps.size() > 1) steps += step, cycles += own;
    const Summary& summary = report.last().summary;
    fmt::print("| {} | {} | {} | {:.3f} |\n", report.steps.size(), summary.level_unknowns.back(), summary.iterations,
               step / own);
    std::fflush(stdout);
  });
  const Assemblies& count = driver.report().time.assemblies;
  fmt::print(
      "\nAfter the first step, all together: {:.3f}. On all levels and in all steps {} matrices and {} loads were "
      "assembled.\n",
      steps / cycles, count.stiffness, count.load);
}

}  // namespace signorini::bench
