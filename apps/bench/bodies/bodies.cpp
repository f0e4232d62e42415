#include "apps/bench/bodies/bodies.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/bench/processor_time.hpp"
#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

std::string material(double young) { return fmt::format("order = 1\nyoung = {}\npoisson = 0.3\n", young); }

std::string contact(const std::string& body, const std::string& other) {
  return fmt::format(
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"{}\"\non = \"curved\"\nother = \"{}\"\n"
      "other_on = \"top\"\n",
      body, other);
}

/// A half disk on a block whose modulus is `young` times its own.
std::string disk(double young) {
  return "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\n"
         "size = \"0.03 + 0.3 * sqrt(x^2 + y^2)\"\n" +
         material(1) + tables::block("block", "[-2, -2]", "[2, 0]", "[32, 16]", material(young)) +
         tables::fix("disk", "flat", "[0, -0.02]") + tables::fix("block", "bottom", "[0, 0]") +
         contact("disk", "block");
}

/// The same of a half ball.
std::string ball(double young) {
  return "[[body]]\nname = \"ball\"\nshape = \"half_ball\"\ncenter = [0, 0, 1]\nradius = 1\n"
         "size = \"0.06 + 0.35 * sqrt(x^2 + y^2 + z^2)\"\n" +
         material(1) + tables::block("block", "[-1, -1, -1]", "[1, 1, 0]", "[12, 12, 6]", material(young)) +
         tables::fix("ball", "flat", "[0, 0, -0.03]") + tables::fix("block", "bottom", "[0, 0, 0]") +
         contact("ball", "block");
}

void row(const char* name, double young, const std::string& scene, int refinements) {
  double first = 0, force = 0;
  for (const char* way : {"jumps", "dirichlet-neumann"}) {
    const ProcessorTime time;
    Driver driver(parse_scene(
        scene, "bodies.toml", ".",
        std::vector<std::string>{fmt::format("refine.uniform={}", refinements), fmt::format("solver.bodies={}", way)}));
    const StepReport& step = driver.solve().last();
    const double seconds = time.elapsed();
    const std::vector<double>& f = step.contact[0].force;
    if (first == 0) first = seconds, force = f.back();
    const Index unknowns = step.summary.level_unknowns.back();
    fmt::print("| {} | {:g} | {} | {} | {} | {:.2f} | {:.2f} | {:.0e} | {} |\n", name, young, unknowns, way,
               step.summary.iterations, seconds, seconds / first, std::abs(f.back() / force - 1),
               step.summary.converged() ? step.summary.reason : "not solved: " + step.summary.reason);
    std::fflush(stdout);
  }
}

}  // namespace

void print_bodies(bool quick) {
  fmt::print(
      "\n## Two bodies as one problem and in turns\n\n| scene | modulus of the block | unknowns | way | cycles | "
      "seconds "
      "| ratio | force differs by | it ended because |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double young : {100.0, 4.0, 1.0})
    for (int refinements = 2; refinements <= (quick ? 2 : 4); ++refinements)
      row("disk", young, disk(young), refinements);
  for (const double young : {100.0, 1.0})
    for (int refinements = 0; refinements <= (quick ? 0 : 2); ++refinements)
      row("ball", young, ball(young), refinements);
}

}  // namespace signorini::bench
