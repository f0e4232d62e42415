#include "apps/bench/peers/calculix.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "apps/bench/friction/friction_scenes.hpp"
#include "apps/bench/peers/calculix_program.hpp"
#include "apps/bench/processor_time.hpp"
#include "apps/bench/scratch_folder.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;

constexpr double friction = 0.3;
constexpr Point<3> top{0.01, 0.005, -0.03};
// An increment of penalty friction: forces to a ten millionth of their mean, displacements likewise.
constexpr const char* controls = "*CONTROLS, PARAMETERS=FIELD\n1e-7, 1e-7, 0.01, , 1e-7\n";

/// What the plane exerts.
struct Forces {
  double normal = 0, tangential[2] = {};
};

struct Solve {
  Forces forces;
  double seconds = 0;
  int iterations = 0;
  double unknowns = 0;
};

Solve own(const FrictionScene& scene, const Overrides& more) {
  Solve out;
  const ProcessorTime time;
  Driver driver(scene.with(friction, more));
  const StepReport& step = driver.solve().last();
  out.seconds = time.elapsed();
  if (!step.summary.converged()) throw Error(Exit::input, "calculix: " + step.summary.reason);
  const std::vector<double>& f = step.contact[0].force;
  out.forces = {f[2], {f[0], f[1]}};
  out.iterations = step.summary.iterations;
  out.unknowns = step.summary.level_unknowns.back();
  return out;
}

std::vector<Index> vertices_at(const Mesh<3>& mesh, double z) {
  std::vector<Index> out;
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (std::abs(mesh.points[v][2] - z) < 1e-9) out.push_back(v);
  return out;
}

/// The block on one element that is held at all its nodes and stands for the plane: node to surface contact with
/// penalties, linear geometry, one increment.
void write_deck(const fs::path& file, const Mesh<3>& mesh, double penalty) {
  auto out = fmt::output_file(file.string());
  const Index n = mesh.vertices();
  out.print("*NODE, NSET=ALL\n");
  for (Index v = 0; v < n; ++v)
    out.print("{},{:.12g},{:.12g},{:.12g}\n", v + 1, mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
  out.print("*NODE, NSET=PLANE\n");
  int next = n;
  for (const double z : {-1.0, 0.0})
    for (const auto& [x, y] : {std::pair{-1, -1}, {3, -1}, {3, 2}, {-1, 2}})
      out.print("{},{},{},{}\n", ++next, x, y, z);
  out.print("*ELEMENT, TYPE=C3D4, ELSET=BLOCK\n");
  std::size_t number = 0;
  for (const auto& e : mesh.elements) out.print("{},{},{},{},{}\n", ++number, e[0] + 1, e[1] + 1, e[2] + 1, e[3] + 1);
  out.print("*ELEMENT, TYPE=C3D8, ELSET=GROUND\n{}", ++number);
  for (int k = 1; k <= 8; ++k) out.print(",{}", n + k);
  for (const auto& [name, z] : {std::pair{"TOP", 1.0}, {"BOTTOM", 0.0}}) {
    out.print("\n*NSET, NSET={}\n", name);
    for (const Index v : vertices_at(mesh, z)) out.print("{},\n", v + 1);
  }
  out.print("*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n");
  for (const char* set : {"BLOCK", "GROUND"}) out.print("*SOLID SECTION, ELSET={}, MATERIAL=M\n", set);
  out.print("*SURFACE, NAME=UPPER\n{},S2\n*SURFACE, NAME=LOWER, TYPE=NODE\nBOTTOM\n", number);
  out.print(
      "*CONTACT PAIR, INTERACTION=ROUGH, TYPE=NODE TO SURFACE\nLOWER, UPPER\n*SURFACE INTERACTION, NAME=ROUGH\n"
      "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}, 1e-9, 0.01\n*FRICTION\n{}, {}\n",
      penalty, friction, penalty);
  out.print("{}*STEP, INC=1000\n*STATIC\n1., 1.\n*BOUNDARY\nPLANE, 1, 3\n", controls);
  for (int i = 0; i < 3; ++i) out.print("TOP, {0}, {0}, {1:.10g}\n", i + 1, top[i]);
  out.print("*NODE PRINT, NSET=PLANE, TOTALS=ONLY\nRF\n*END STEP\n");
}

/// None where CalculiX ends without a result, or takes more than `limit` seconds.
std::optional<Solve> calculix(const fs::path& folder, const Mesh<3>& mesh, double penalty, double limit) {
  write_deck(folder / "block.inp", mesh, penalty);
  const auto run = run_calculix(folder, "block", limit);
  if (!run) return {};
  const auto& f = run->force;  // what holds the plane holds the block through it
  return Solve{{f[2], {f[0], f[1]}}, run->seconds, run->iterations, 0};
}

void row(const char* solver, const Solve& s, double first, const Forces& exact) {
  const double size = std::hypot(exact.tangential[0], exact.tangential[1]);
  fmt::print(
      "| {:.0f} | {} | {:.2f} | {:.2f} | {} | {:.0e} | {:.0e} |\n", s.unknowns, solver, s.seconds, s.seconds / first,
      s.iterations, std::abs(s.forces.normal - exact.normal) / exact.normal,
      std::hypot(s.forces.tangential[0] - exact.tangential[0], s.forces.tangential[1] - exact.tangential[1]) / size);
  std::fflush(stdout);
}

void compare(const fs::path& folder, int refinements, bool direct, double limit) {
  const FrictionScene scene = block_3d("block", "[0.01, 0.005, -0.03]", refinements);
  const Forces exact =
      own(scene, {direct ? "solver.method=newton" : "solver.method=auto", "solver.tolerance=1e-12"}).forces;
  const Solve ours = own(scene, {});
  row("signorini", ours, ours.seconds, exact);
  Driver driver(scene.with(friction));
  driver.solve();
  for (const double penalty : {1e2, 1e3, 1e4, 1e5}) {
    std::optional<Solve> theirs;
    driver.visit(0, [&](const auto& body) {
      if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<3, 3>>)
        theirs = calculix(folder, body.mesh(), penalty, limit);
    });
    const std::string name = fmt::format("CalculiX, penalty {:g}", penalty);
    if (theirs) {
      theirs->unknowns = ours.unknowns;
      row(name.c_str(), *theirs, ours.seconds, exact);
    } else {
      fmt::print("| {:.0f} | {} | none in {} s | | | | |\n", ours.unknowns, name, limit);
    }
    std::fflush(stdout);
  }
}

}  // namespace

void print_calculix(bool quick) {
  require_calculix();
  const ScratchFolder scratch("calculix");
  const fs::path& folder = scratch.path();
  fmt::print(
      "\n## Block with friction 0.3 on a plane, on the same meshes\n\n| unknowns | solver | seconds | ratio | "
      "iterations | error of the normal force | of the tangential force |\n| --- | --- | --- | --- | --- | --- | --- "
      "|\n");
  compare(folder, 1, true, 300);
  compare(folder, 2, true, 300);
  if (!quick) compare(folder, 3, true, 900);
}

}  // namespace signorini::bench
