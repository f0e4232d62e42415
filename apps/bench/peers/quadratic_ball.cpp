#include "apps/bench/peers/quadratic_ball.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "apps/bench/accuracy/known_answers.hpp"
#include "apps/bench/peers/calculix_program.hpp"
#include "apps/bench/peers/child.hpp"
#include "apps/bench/scratch_folder.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;

constexpr double most_times = 100;    // our own time, on the largest mesh
constexpr double lowest_part = -0.9;  // below it lies far more than what touches

/// Faces of elements with ten nodes, in CalculiX's order.
constexpr int face_corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
// The nodes of a family in the order of others.
constexpr int order_of_calculix[10] = {0, 1, 2, 3, 4, 7, 5, 6, 8, 9};
constexpr int order_of_gmsh[10] = {0, 1, 2, 3, 4, 7, 5, 6, 9, 8};

std::array<Index, 3> sorted(std::array<Index, 3> corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Faces of elements on the lowest part of the boundary: number of the element, of its face.
std::vector<std::pair<std::size_t, int>> lowest_faces(const Mesh<3>& mesh) {
  std::map<std::array<Index, 3>, std::pair<std::size_t, int>> faces;
  for (std::size_t e = 0; e < mesh.families.size(); ++e)
    for (int f = 0; f < 4; ++f) {
      const auto corner = [&](int k) { return mesh.families[e][face_corners[f][k]]; };
      faces[sorted({corner(0), corner(1), corner(2)})] = {e + 1, f + 1};
    }
  const Nodes<3> nodes(mesh, 2);
  std::vector<std::pair<std::size_t, int>> out;
  for (Index f = 0; f < std::ssize(mesh.boundary); f += nodes.faces_per_element()) {
    const auto face = nodes.element_face<2>(f);
    const bool low =
        std::all_of(face.begin(), face.begin() + 3, [&](Index v) { return mesh.points[v][2] < lowest_part; });
    if (low) out.push_back(faces.at(sorted({face[0], face[1], face[2]})));
  }
  return out;
}

/// The half ball of quadratic tetrahedra on one element that is held at all its nodes and stands for the plane.
void write_deck(const fs::path& file, const Mesh<3>& mesh, double penalty) {
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
  std::size_t number = 0;
  for (const Family<3>& e : mesh.families) {
    out.print("{}", ++number);
    for (const int k : order_of_calculix) out.print(",{}", e[k] + 1);
    out.print("\n");
  }
  out.print("*ELEMENT, TYPE=C3D8, ELSET=GROUND\n{}", ++number);
  for (Index k = 1; k <= 8; ++k) out.print(",{}", mesh.vertices() + k);
  out.print("\n*NSET, NSET=FLAT\n");
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (std::abs(mesh.points[v][2]) < 1e-9) out.print("{},\n", v + 1);
  out.print("*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n");
  for (const char* set : {"BALL", "GROUND"}) out.print("*SOLID SECTION, ELSET={}, MATERIAL=M\n", set);
  out.print("*SURFACE, NAME=UPPER\n{},S2\n*SURFACE, NAME=LOWER\n", number);
  for (const auto& [element, side] : lowest_faces(mesh)) out.print("{},S{}\n", element, side);
  out.print(
      "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE\nLOWER, UPPER\n*SURFACE INTERACTION, NAME=HARD\n"
      "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}\n*STEP, INC=1000\n*STATIC\n1., 1.\n*BOUNDARY\nPLANE, 1, 3\n"
      "FLAT, 1, 2\nFLAT, 3, 3, -0.011\n*NODE PRINT, NSET=PLANE, TOTALS=ONLY\nRF\n*END STEP\n",
      penalty);
}

void write_gmsh(const fs::path& file, const Mesh<3>& mesh) {
  auto out = fmt::output_file(file.string());
  out.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.vertices());
  for (Index v = 0; v < mesh.vertices(); ++v)
    out.print("{} {:.16g} {:.16g} {:.16g}\n", v + 1, mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
  out.print("$EndNodes\n$Elements\n{}\n", mesh.families.size());
  for (std::size_t e = 0; e < mesh.families.size(); ++e) {
    out.print("{} 11 2 1 1", e + 1);
    for (const int k : order_of_gmsh) out.print(" {}", mesh.families[e][k] + 1);
    out.print("\n");
  }
  out.print("$EndElements\n");
}

std::optional<Answer> calculix(const fs::path& folder, const Mesh<3>& mesh, double penalty, double limit) {
  write_deck(folder / "ball.inp", mesh, penalty);
  const auto run = run_calculix(folder, "ball", limit);
  if (!run) return {};
  Answer out;
  out.force = std::abs(run->force[2]);
  out.seconds = run->seconds;
  out.cycles = run->iterations;
  return out;
}

// Debian's package is one of Debian's Python.
const std::string python = "/usr/bin/python3";

bool has_getfem() { return run_child(python + " -c 'import getfem' > /dev/null 2>&1", 60).ended_well; }

std::optional<Answer> getfem(const fs::path& folder, const Mesh<3>& mesh, double limit) {
  write_gmsh(folder / "ball.msh", mesh);
  const ChildRun run = run_child(fmt::format("{} {} '{}' > '{}' 2> /dev/null", python, SIGNORINI_GETFEM_BALL,
                                             (folder / "ball.msh").string(), (folder / "result").string()),
                                 limit);
  Answer out;
  out.seconds = run.seconds;
  if (!run.ended_well) return {};
  std::ifstream(folder / "result") >> out.cycles >> out.force >> out.peak;
  return out;
}

/// The rows of one mesh.
class Comparison {
 public:
  /// @param limit seconds, or so many times our own time where that is not given
  Comparison(const AccuracyProblem& problem, int refinements, std::optional<double> limit) : problem_(problem) {
    const std::vector<std::string> overrides{"body.0.order=2", fmt::format("refine.uniform={}", refinements)};
    own_ = solve(problem.question, overrides, [&](Driver& driver) {
      driver.visit(0, [&](const auto& body) {
        if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<3, 3>>) mesh_ = body.mesh();
      });
    });
    row("signorini", own_);
    limit_ = limit.value_or(most_times * own_.seconds);
  }

  const Mesh<3>& mesh() const { return mesh_; }
  double limit() const { return limit_; }

  void row(const std::string& name, const std::optional<Answer>& found) const {
    if (!found) {
      fmt::print("| {:.0f} | {} | none in {:.0f} | > {:.0f} | | | |\n", own_.unknowns, name, limit_,
                 limit_ / own_.seconds);
    } else {
      const Errors errors = errors_of(*found, problem_.exact, {});
      const auto percent = [](double error) { return std::isnan(error) ? "" : fmt::format("{:+.3f} %", 100 * error); };
      fmt::print("| {:.0f} | {} | {:.2f} | {:.1f} | {} | {} | {} |\n", own_.unknowns, name, found->seconds,
                 found->seconds / own_.seconds, found->cycles, percent(errors[0]), percent(errors[1]));
    }
    std::fflush(stdout);
  }

 private:
  const AccuracyProblem& problem_;
  double limit_ = 0;
  Answer own_;
  Mesh<3> mesh_;
};

}  // namespace

void print_quadratic_ball(bool quick, const std::string& only) {
  const ScratchFolder scratch("peers");
  const auto wanted = [&](std::string_view name) { return name.find(only) != std::string_view::npos; };
  const bool with_getfem = wanted("GetFEM") && has_getfem(), with_calculix = wanted("CalculiX") && has_calculix();
  if (!with_getfem && !with_calculix)
    throw Error(Exit::input, "there is neither ccx nor Python's getfem: ./dev setup peers installs both");
  AccuracyProblem problem = ball_in_space(1, scratch.path());
  problem.exact.stress.clear();  // peers are asked for force and pressure
  fmt::print(
      "\n## The ball on the same quadratic meshes\n\n| unknowns | solver | seconds | ratio | iterations | force | "
      "largest "
      "pressure |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  constexpr double half_an_hour = 1800;
  for (int k = 0; k <= (quick ? 1 : 2); ++k) {
    const Comparison comparison(problem, k, k < 2 ? std::optional(half_an_hour) : std::nullopt);
    if (with_getfem) comparison.row("GetFEM, P2", getfem(scratch.path(), comparison.mesh(), comparison.limit()));
    if (!with_calculix) continue;
    // where a run may take an hour, one of them
    for (const double penalty : k < 2 ? std::vector{1e2, 1e3, 1e4} : std::vector{1e3})
      comparison.row(fmt::format("CalculiX, C3D10, penalty {:g}", penalty),
                     calculix(scratch.path(), comparison.mesh(), penalty, comparison.limit()));
  }
}

}  // namespace signorini::bench
