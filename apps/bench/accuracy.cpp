#include "apps/bench/accuracy.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <map>
#include <numbers>

#include "apps/bench/calculix_program.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

constexpr double modulus = 1 / (1 - 0.09);  // of all scenes: young = 1, poisson = 0.3

struct Answer {
  double unknowns = 0, force = 0, peak = 0, radius = 0, seconds = 0;
  int cycles = 0;
};

/// @param look at the driver afterwards
template <class Look>
Answer solve(const std::string& file, int order, int refinements, const Look& look) {
  Answer out;
  const ProcessorTime time;
  const std::vector<std::string> overrides{fmt::format("refine.uniform={}", refinements),
                                           fmt::format("body.0.order={}", order)};
  Driver driver(read_scene(scene_file(file), overrides));
  const StepReport& step = driver.solve([] {}).last();
  out.seconds = time.elapsed();
  if (!step.summary.converged()) throw Error(Exit::not_converged, step.summary.reason);
  const ContactReport& contact = step.contact[0];
  out.unknowns = static_cast<double>(step.summary.level_unknowns.back());
  out.force = contact.force.back();
  out.peak = contact.max_pressure;
  out.radius = contact.radius;
  out.cycles = step.summary.iterations;
  look(driver);
  return out;
}

Answer solve(const std::string& file, int order, int refinements) {
  return solve(file, order, refinements, [](Driver&) {});
}

/// Hertz (1882) for a given force on a ball or cylinder of radius 1; see Johnson, Contact Mechanics, ch. 4.
Answer hertz(bool ball, double force) {
  Answer out;
  out.force = force;
  out.radius = ball ? std::cbrt(3 * force / (4 * modulus)) : std::sqrt(4 * force / (pi * modulus));
  out.peak = ball ? 3 * force / (2 * pi * out.radius * out.radius) : 2 * force / (pi * out.radius);
  return out;
}

/// What the last two of a sequence with errors of order two tend to.
double limit_of(double coarser, double finer) { return finer + (finer - coarser) / 3; }

void head() {
  fmt::print(
      "| solver | unknowns | seconds | cycles | force | largest pressure | radius |\n| --- | --- | --- | --- | --- | "
      "--- | --- |\n");
}

std::string error(double value, double exact) {
  return value > 0 ? fmt::format("{:+.2f} %", 100 * (value / exact - 1)) : "";
}

void row(const std::string& solver, const Answer& a, const Answer& exact) {
  fmt::print("| {} | {:.0f} | {:.2f} | {} | {} | {} | {} |\n", solver, a.unknowns, a.seconds, a.cycles,
             error(a.force, exact.force), error(a.peak, exact.peak), error(a.radius, exact.radius));
  std::fflush(stdout);
}

/// Faces of elements with ten nodes, in CalculiX's order.
constexpr int face_corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

/// The half ball of quadratic tetrahedra on one element that is held at all its nodes and stands for the plane.
void write_ball(const fs::path& file, const Mesh<3>& mesh, double penalty) {
  auto out = fmt::output_file(file.string());
  out.print("*NODE, NSET=ALL\n");
  for (Index v = 0; v < mesh.vertices(); ++v)
    out.print("{},{:.12g},{:.12g},{:.12g}\n", v + 1, mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
  out.print("*NODE, NSET=PLANE\n");
  Index next = mesh.vertices();
  for (const double z : {-2.0, -1.0})
    for (const auto& [x, y] : {std::pair{-2, -2}, {2, -2}, {2, 2}, {-2, 2}})
      out.print("{},{},{},{}\n", ++next, x, y, z);
  out.print("*ELEMENT, TYPE=C3D10, ELSET=BALL\n");
  std::map<std::array<Index, 3>, std::pair<std::size_t, int>> faces;
  const auto sorted = [](std::array<Index, 3> corners) {
    std::ranges::sort(corners);
    return corners;
  };
  std::size_t number = 0;
  for (const Family<3>& e : mesh.families) {
    out.print("{}", ++number);
    for (const int k : {0, 1, 2, 3, 4, 7, 5, 6, 8, 9}) out.print(",{}", e[k] + 1);
    out.print("\n");
    for (int f = 0; f < 4; ++f)
      faces[sorted({e[face_corners[f][0]], e[face_corners[f][1]], e[face_corners[f][2]]})] = {number, f + 1};
  }
  out.print("*ELEMENT, TYPE=C3D8, ELSET=GROUND\n{}", ++number);
  for (Index k = 1; k <= 8; ++k) out.print(",{}", mesh.vertices() + k);
  out.print("\n*NSET, NSET=FLAT\n");
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (std::abs(mesh.points[v][2]) < 1e-9) out.print("{},\n", v + 1);
  out.print("*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n");
  for (const char* set : {"BALL", "GROUND"}) out.print("*SOLID SECTION, ELSET={}, MATERIAL=M\n", set);
  out.print("*SURFACE, NAME=UPPER\n{},S2\n*SURFACE, NAME=LOWER\n", number);
  const Nodes<3> nodes(mesh, 2);
  for (Index f = 0; f < std::ssize(mesh.boundary); f += nodes.faces_per_element()) {
    const auto face = nodes.element_face<2>(f);
    const auto [element, side] = faces.at(sorted({face[0], face[1], face[2]}));
    double highest = -1;
    for (int k = 0; k < 3; ++k) highest = std::max(highest, mesh.points[face[k]][2]);
    if (highest < -0.9) out.print("{},S{}\n", element, side);  // far more than what touches
  }
  out.print(
      "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE\nLOWER, UPPER\n*SURFACE INTERACTION, NAME=HARD\n"
      "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}\n*STEP, INC=1000\n*STATIC\n1., 1.\n*BOUNDARY\nPLANE, 1, 3\n"
      "FLAT, 1, 2\nFLAT, 3, 3, -0.011\n*NODE PRINT, NSET=PLANE, TOTALS=ONLY\nRF\n*END STEP\n",
      penalty);
}

void print_calculix_ball(int refinements, double penalty, double limit, const Answer& exact) {
  const fs::path folder = calculix_folder();
  const Answer answer = solve("ball_on_plane.toml", 2, refinements, [&](Driver& driver) {
    driver.visit(0, [&](const auto& body) {
      if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<3, 3>>)
        write_ball(folder / "ball.inp", body.mesh(), penalty);
    });
  });
  const std::string name = fmt::format("CalculiX, C3D10, penalty {:g}", penalty);
  if (const auto run = run_calculix(folder, "ball", limit)) {
    row(name, {answer.unknowns, std::abs(run->force[2]), 0, 0, run->seconds, run->iterations}, exact);
  } else {
    fmt::print("| {} | {:.0f} | none in {} | | | | |\n", name, answer.unknowns, limit);
  }
  fs::remove_all(folder);
}

void print_scene(const std::string& file, const Answer& exact, std::array<int, 2> linear,
                 std::array<int, 2> quadratic) {
  for (const auto& [order, range] : {std::pair{1, linear}, {2, quadratic}})
    for (int k = range[0]; k <= range[1]; ++k)
      row(order == 1 ? "linear elements" : "quadratic elements", solve(file, order, k), exact);
}

}  // namespace

void print_accuracy(bool quick) {
  const int less = quick ? 1 : 0;
  const std::string meridian = "ball_axisymmetric.toml", cylinder = "cylinder_on_plane_2d.toml";
  const Answer ball = hertz(true, limit_of(solve(meridian, 1, 6 - less).force, solve(meridian, 1, 7 - less).force));
  fmt::print("\n## Ball on a plane, in space\n\nReference: force {:.6e}, pressure {:.6f}, radius {:.6f}\n\n",
             ball.force, ball.peak, ball.radius);
  head();
  print_scene("ball_on_plane.toml", ball, {0, 3 + 1 - less}, {0, 3 - less});
  if (std::system("command -v ccx > /dev/null") == 0)
    for (int k = 0; k <= 2 - less; ++k)
      for (const double penalty : {1e2, 1e3, 1e4}) print_calculix_ball(k, penalty, k < 2 ? 300 : 900, ball);
  fmt::print("\n## The axisymmetric ball\n\n");
  head();
  print_scene(meridian, ball, {0, 6 - less}, {0, -1});
  const Answer line = hertz(false, limit_of(solve(cylinder, 2, 5 - less).force, solve(cylinder, 2, 6 - less).force));
  fmt::print(
      "\n## Cylinder on a plane, plane strain\n\nReference: force {:.6e}, pressure {:.6f}, half width {:.6f}\n\n",
      line.force, line.peak, line.radius);
  head();
  print_scene(cylinder, line, {0, 7 - less}, {0, 6 - less});
}

}  // namespace signorini::bench
