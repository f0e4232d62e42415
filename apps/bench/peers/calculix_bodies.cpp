#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>

#include "apps/bench/peers/calculix_bodies.hpp"
#include "apps/bench/peers/calculix_program.hpp"
#include "apps/bench/processor_time.hpp"
#include "apps/bench/scratch_folder.hpp"
#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;

constexpr double friction = 0.3;
constexpr Point<3> top{0.005, 0, -0.02};

/// A block on a larger one, meshes of which do not match, pressed and pushed aside.
Scene scene(int refinements, const std::string& tolerance) {
  return parse_scene(
      tables::block("lower", "[0, 0, 0]", "[2, 2, 1]", "[4, 4, 2]") +
          tables::block("upper", "[0.5, 0.5, 1]", "[1.5, 1.5, 1.75]", "[3, 3, 3]") +
          tables::fix("lower", "bottom", "[0, 0, 0]") +
          tables::fix("upper", "top", fmt::format("[{}, {}, {}]", top[0], top[1], top[2])) +
          fmt::format("[[obstacle]]\ntype = \"elastic_coulomb\"\nbody = \"upper\"\non = \"bottom\"\nother = \"lower\"\n"
                      "other_on = \"top\"\nslave = \"body\"\nfriction = {}\n[solver]\ntolerance = {}\n[refine]\n"
                      "uniform = {}\n",
                      friction, tolerance, refinements),
      "blocks.toml", ".");
}

/// On the upper block.
struct Forces {
  double normal = 0, across = 0;
};

Forces forces_of(const ContactReport& contact) { return {contact.force[2], contact.force[0]}; }

/// CalculiX's number of the side of a tetrahedron that has the face.
int side(const std::array<Index, 4>& element, const Face<3>& face) {
  constexpr int opposite[] = {3, 4, 2, 1};
  for (int k = 0; k < 4; ++k)
    if (std::ranges::find(face.vertices, element[k]) == face.vertices.end()) return opposite[k];
  return 0;
}

void print_surface(fmt::ostream& out, const Mesh<3>& mesh, const char* name, const std::string& part) {
  out.print("*SURFACE, NAME={}\n", name);
  for (const Index f : std::ranges::find(mesh.parts, part, &Part::name)->faces)
    out.print("{},S{}\n", mesh.boundary[f].element + 1,
              side(mesh.elements[mesh.boundary[f].element], mesh.boundary[f]));
}

void write_deck(const fs::path& file, const Mesh<3>& mesh, const std::string& type) {
  auto out = fmt::output_file(file.string());
  out.print("*NODE, NSET=ALL\n");
  for (Index v = 0; v < mesh.vertices(); ++v)
    out.print("{},{:.12g},{:.12g},{:.12g}\n", v + 1, mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
  out.print("*ELEMENT, TYPE=C3D4, ELSET=BODIES\n");
  std::size_t number = 0;
  for (const auto& e : mesh.elements) out.print("{},{},{},{},{}\n", ++number, e[0] + 1, e[1] + 1, e[2] + 1, e[3] + 1);
  for (const auto& [name, z] : {std::pair{"BOTTOM", 0.0}, {"TOP", 1.75}}) {
    out.print("*NSET, NSET={}\n", name);
    for (Index v = 0; v < mesh.vertices(); ++v)
      if (std::abs(mesh.points[v][2] - z) < 1e-9) out.print("{},\n", v + 1);
  }
  out.print("*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n*SOLID SECTION, ELSET=BODIES, MATERIAL=M\n");
  print_surface(out, mesh, "SLAVE", "upper/bottom");
  print_surface(out, mesh, "MASTER", "lower/top");
  const bool mortar = type.find("MORTAR") != std::string::npos;
  out.print("*CONTACT PAIR, INTERACTION=ROUGH, TYPE={}\nSLAVE, MASTER\n*SURFACE INTERACTION, NAME=ROUGH\n", type);
  out.print("{}*FRICTION\n{}, 1e4\n",
            mortar ? "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n"
                   : "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e4, 1e-9\n",
            friction);
  out.print("*STEP, INC=1000\n*STATIC\n1., 1.\n*BOUNDARY\nBOTTOM, 1, 3\n");
  for (int i = 0; i < 3; ++i) out.print("TOP, {0}, {0}, {1:.10g}\n", i + 1, top[i]);
  out.print("*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY\nRF\n*END STEP\n");
}

void row(double unknowns, const std::string& solver, double seconds, double first, int iterations, const Forces& found,
         const Forces& exact) {
  fmt::print("| {:.0f} | {} | {:.2f} | {:.1f} | {} | {:.1e} | {:.1e} |\n", unknowns, solver, seconds, seconds / first,
             iterations, std::abs(found.normal / exact.normal - 1), std::abs(found.across / exact.across - 1));
  std::fflush(stdout);
}

void compare(const fs::path& folder, int refinements, const Forces& exact, double limit) {
  const ProcessorTime time;
  Driver driver(scene(refinements, "1e-8"));
  const StepReport& step = driver.solve().last();
  const double seconds = time.elapsed(), unknowns = step.summary.level_unknowns.back();
  row(unknowns, "signorini", seconds, seconds, step.summary.iterations, forces_of(step.contact[0]), exact);
  for (const char* type : {"LINMORTAR", "SURFACE TO SURFACE"}) {
    driver.visit(0, [&](const auto& body) {
      if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<3, 3>>)
        write_deck(folder / "blocks.inp", body.mesh(), type);
    });
    const auto run = run_calculix(folder, "blocks", limit);
    const std::string name = fmt::format("CalculiX, {}", type);
    if (run)
      row(unknowns, name, run->seconds, seconds, run->iterations, {run->force[2], run->force[0]}, exact);
    else
      fmt::print("| {:.0f} | {} | none in {} s | | | | |\n", unknowns, name, limit);
  }
}

}  // namespace

void print_calculix_bodies(bool quick) {
  require_calculix();
  const ScratchFolder scratch("calculix_bodies");
  const fs::path& folder = scratch.path();
  const int finest = quick ? 3 : 4;
  Driver driver(scene(finest, "1e-8"));
  const Forces exact = forces_of(driver.solve().last().contact[0]);
  fmt::print(
      "\n## Two blocks with friction {} beside CalculiX, on the same meshes\n\n| unknowns | solver | seconds | ratio | "
      "iterations | normal force off by | force across off by |\n| --- | --- | --- | --- | --- | --- | --- |\n",
      friction);
  for (int refinements = 0; refinements < finest; ++refinements) compare(folder, refinements, exact, 900);
  fmt::print("\nOff from a solve on a mesh twice as fine as the last one.\n");
}

}  // namespace signorini::bench
