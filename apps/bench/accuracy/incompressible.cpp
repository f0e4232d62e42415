#include "apps/bench/accuracy/incompressible.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/bench/problems.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

struct Measured {
  double unknowns = 0, force = 0, peak = 0, probe = 0;
  int cycles = 0;
};

struct Pressed {
  const char* title;
  std::string text;
  int refinements;  ///< of quadratic elements; the reference has as many more as `finer`
  int finer = 1;
};

struct Element {
  const char* name;
  int order;
  const char* pressure;
};

const Element elements[] = {{"linear", 1, "none"},
                            {"quadratic", 2, "none"},
                            {"quadratic, constant pressure", 2, "constant"},
                            {"quadratic, linear pressure", 2, "linear"}};
constexpr double ratios[] = {0.3, 0.45, 0.49, 0.499, 0.4999};

/// Between smooth walls: where a clamped side meets a free one stresses are infinite, the more so the larger Poisson's
/// ratio is.
const std::string pressed_2d = R"toml(
[[body]]
name = "b"
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [4, 4]
young = 1
poisson = 0.3
[[fix]]
body = "b"
on = "top"
value = ["free", -0.05]
[[fix]]
body = "b"
on = "left"
value = [0, "free"]
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "expression"
distance = "y + 0.2*x^2"
normal = [0, 1]
)toml";

const std::string pressed_3d = R"toml(
[[body]]
name = "b"
shape = "box"
from = [0, 0, 0]
to = [1, 1, 1]
cells = [3, 3, 3]
young = 1
poisson = 0.3
[[fix]]
body = "b"
on = "top"
value = ["free", "free", -0.05]
[[fix]]
body = "b"
on = "left"
value = [0, "free", "free"]
[[fix]]
body = "b"
on = "front"
value = ["free", 0, "free"]
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "expression"
distance = "z + 0.2*(x^2 + y^2)"
normal = [0, 0, 1]
)toml";

const std::string punch_2d = R"toml(
[[body]]
name = "b"
shape = "rectangle"
from = [-4, 0]
to = [4, 4]
cells = [16, 8]
young = 1
poisson = 0.3
[[fix]]
body = "b"
on = "top"
value = [0, -0.01]
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "expression"
distance = "abs(x) < 0.501 ? y : y + 1"
normal = [0, 1]
)toml";

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

/// E = 250, a total shear force of 100 on the right side of 16; the plane is far away.
const std::string cook = R"toml(
[[body]]
name = "b"
shape = "polygon"
points = [[0, 0], [48, 44], [48, 60], [0, 44]]
size = 12
young = 250
poisson = 0.3
[[fix]]
body = "b"
where = "x < 1e-6"
value = [0, 0]
[[load]]
body = "b"
where = "x > 47.999999"
value = [0, 6.25]
[[probe]]
name = "tip"
body = "b"
at = [48, 60]
)toml";

Measured solve(const std::string& text, const Element& element, double poisson, int refinements) {
  const std::vector<std::string> overrides{
      fmt::format("body.0.order={}", element.order), fmt::format("body.0.pressure={}", element.pressure),
      fmt::format("body.0.poisson={}", poisson), fmt::format("refine.uniform={}", refinements + 2 - element.order)};
  Driver driver(parse_scene(text, "incompressible", ".", overrides));
  driver.solve([] {});
  Measured out;
  const StepReport& last = driver.report().last();
  if (!last.summary.converged()) throw Error(Exit::not_converged, last.summary.reason);
  out.unknowns = static_cast<double>(last.summary.level_unknowns.back());
  out.cycles = last.summary.iterations;
  if (!last.contact.empty()) {
    out.force = last.contact[0].force.back();
    out.peak = last.contact[0].max_pressure;
  }
  if (!last.probes.empty()) out.probe = last.probes[0].value.back();
  return out;
}

void print_errors(const Pressed& problem) {
  fmt::print("### {}\n\n| poisson |", problem.title);
  for (const Element& element : elements) fmt::print(" {} |", element.name);
  fmt::print("\n| --- |");
  for (std::size_t k = 0; k < std::size(elements); ++k) fmt::print(" --- |");
  fmt::print("\n");
  for (const double poisson : ratios) {
    const Measured exact = solve(problem.text, elements[3], poisson, problem.refinements + problem.finer);
    fmt::print("| {} |", poisson);
    for (const Element& element : elements) {
      const Measured m = solve(problem.text, element, poisson, problem.refinements);
      fmt::print(" {:+.2f} %, {:+.1f} %, {} |", 100 * (m.force / exact.force - 1), 100 * (m.peak / exact.peak - 1),
                 m.cycles);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("\n");
}

/// Where a pressure with unknowns of its own begins to pay. Up to the ratio of core/fem/model/material.hpp there is
/// none.
void print_threshold(const std::vector<Pressed>& problems) {
  fmt::print("### Where a pressure begins to pay\n\n| poisson |");
  for (const Pressed& problem : problems)
    fmt::print(" {}: without, error of the force, cycles | with |", problem.title);
  fmt::print("\n| --- |");
  for (std::size_t k = 0; k < problems.size(); ++k) fmt::print(" --- | --- |");
  fmt::print("\n");
  for (const double poisson : {0.38, 0.4, 0.41, 0.42, 0.43, 0.44, 0.45, 0.46, 0.47, 0.48, 0.49}) {
    fmt::print("| {} |", poisson);
    for (const Pressed& problem : problems) {
      const Measured exact = solve(problem.text, elements[3], poisson, problem.refinements + problem.finer);
      for (const int k : {1, 3}) {
        const Measured m = solve(problem.text, elements[k], poisson, problem.refinements);
        fmt::print(" {:+.3f} %, {} |", 100 * (m.force / exact.force - 1), m.cycles);
      }
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_cook(int finest) {
  fmt::print("### Cook's membrane, poisson = 0.4999\n\n| unknowns |");
  for (const Element& element : elements) fmt::print(" {} |", element.name);
  fmt::print("\n| --- |");
  for (std::size_t k = 0; k < std::size(elements); ++k) fmt::print(" --- |");
  fmt::print("\n");
  for (int k = 0; k <= finest; ++k) {
    std::string row;
    double unknowns = 0;
    for (const Element& element : elements) {
      const Measured m = solve(cook, element, 0.4999, k);
      row += fmt::format(" {:.4f} ({}) |", m.probe, m.cycles);
      unknowns = m.unknowns;
    }
    fmt::print("| {} |{}\n", unknowns, row);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_cycles(const char* title, const std::string& text, int finest) {
  fmt::print("### Cycles, {}\n\n| unknowns |", title);
  for (const double poisson : ratios) fmt::print(" {} |", poisson);
  fmt::print("\n| --- |");
  for (std::size_t k = 0; k < std::size(ratios); ++k) fmt::print(" --- |");
  fmt::print("\n");
  for (int k = 0; k <= finest; ++k) {
    std::string row;
    double unknowns = 0;
    for (const double poisson : ratios) {
      const Measured m = solve(text, elements[3], poisson, k);
      row += fmt::format(" {} |", m.cycles);
      unknowns = m.unknowns;
    }
    fmt::print("| {} |{}\n", unknowns, row);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

}  // namespace

void print_incompressible(bool quick) {
  const int less = quick ? 1 : 0;
  fmt::print("## Nearly incompressible material\n\nErrors of the force and of the largest pressure, and cycles.\n\n");
  print_threshold({{"block, 2D", pressed_2d, 3, 2}, {"punch, 2D", punch_2d, 2}, {"block, 3D", pressed_3d, 1}});
  print_errors({"A block pressed on a parabola, 2D", pressed_2d, 2, quick ? 1 : 2});
  print_errors({"A flat punch, 2D", punch_2d, 1, quick ? 1 : 2});
  print_errors({"A block pressed on a paraboloid, 3D", pressed_3d, 1 - less});
  print_errors({"A ball on a plane, 3D", text_of(scene_file("ball_on_plane.toml")), 1 - less});
  print_cook(4 - less);
  print_cycles("block in 2D", pressed_2d, 6 - 2 * less);
  print_cycles("block in 3D", pressed_3d, 3 - less);
}

}  // namespace signorini::bench
