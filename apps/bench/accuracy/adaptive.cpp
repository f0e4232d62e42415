#include "apps/bench/accuracy/adaptive.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/bench/processor_time.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

struct Case {
  const char* name;
  const char* scene;
  double tolerance;  ///< of the last adaptive mesh
  double tolerance_quick;
  int uniform;  ///< refinements of the last uniform mesh
};

constexpr Case cases[] = {{"a membrane over a flat obstacle, with an inward corner (2D)", R"(
[[body]]
name = "body"
shape = "polygon"
points = [[0, 0], [1, 0], [1, 1], [-1, 1], [-1, -1], [0, -1]]
size = 0.3
equation = "diffusion"
[[fix]]
body = "body"
on = "boundary"
value = [0]
[[load]]
body = "body"
value = [-1]
[[obstacle]]
type = "scalar"
body = "body"
lower = "-0.05"
)",
                           3e-4, 3e-3, 6},
                          {"an elastic block pressed on an edge of a rigid step (2D)", R"(
[[body]]
name = "body"
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [4, 4]
young = 1
poisson = 0.3
order = 1
[[fix]]
body = "body"
on = "top"
value = [0, -0.01]
[[obstacle]]
type = "contact"
body = "body"
where = "y < 1e-6 && x > 0.5 - 1e-6"
shape = "plane"
point = [0, 0]
normal = [0, 1]
)",
                           3e-3, 3e-2, 6},
                          {"a cube whose bottom rests on a plane with a quarter of it (3D)", R"(
[[body]]
name = "body"
shape = "box"
from = [0, 0, 0]
to = [1, 1, 1]
cells = [2, 2, 2]
young = 1
poisson = 0.3
order = 1
[[fix]]
body = "body"
on = "top"
value = [0, 0, -0.01]
[[obstacle]]
type = "contact"
body = "body"
where = "z < 1e-6 && x > 0.5 - 1e-6 && y > 0.5 - 1e-6"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)",
                           5e-2, 1e-1, 4}};

void row(const char* mesh, Index unknowns, int iterations, const EstimateReport& error, double seconds) {
  fmt::print("| {} | {} | {} | {:.3g} % | {:.3g} % | {:.2f} |\n", mesh, unknowns, iterations,
             100 * error.relative_lower(), 100 * error.relative_upper(), seconds);
  std::fflush(stdout);
}

Scene scene_of(const Case& of, const std::vector<std::string>& overrides) {
  return parse_scene(of.scene, of.name, ".", overrides);
}

void print_case(const Case& of, bool quick) {
  fmt::print(
      "\n### {}\n\n| mesh | unknowns | iterations | error at least | at most | seconds |\n"
      "| --- | --- | --- | --- | --- | --- |\n",
      of.name);
  for (int uniform = 2; uniform <= of.uniform - 2 * quick; uniform += 2) {
    const ProcessorTime time;
    Driver driver(scene_of(of, {fmt::format("refine.uniform={}", uniform), "solver.estimate=true"}));
    const StepReport& last = driver.solve().last();
    row("uniform", last.summary.level_unknowns.back(), last.summary.iterations, *last.estimate, time.elapsed());
  }
  Driver driver(scene_of(of, {"refine.adaptive=true", "refine.uniform=1",
                              fmt::format("refine.tolerance={}", quick ? of.tolerance_quick : of.tolerance)}));
  const Report& report = driver.solve();
  for (const AdaptiveStep& mesh : report.adaptive->steps)
    fmt::print("| adaptive | {} | {} | {:.3g} % | {:.3g} % | {:.2f} |\n", mesh.unknowns, mesh.iterations,
               100 * mesh.error.relative_lower(), 100 * mesh.error.relative_upper(), mesh.seconds);
  std::fflush(stdout);
}

}  // namespace

void print_adaptive(bool quick) {
  fmt::print("## Adaptive meshes\n");
  for (const Case& of : cases) print_case(of, quick);
}

}  // namespace signorini::bench
