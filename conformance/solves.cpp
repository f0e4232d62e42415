// Scenes solved with a plugin, and compared with what Gauss-Seidel steps alone lead to.
#include "conformance/solves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/driver.hpp"

namespace signorini::conformance {
namespace {

constexpr double agreement = 1e-5;  // of solutions to a tolerance of 1e-9, of which Gauss-Seidel falls short

struct Solved {
  std::vector<std::vector<double>> u;  // per body
  int iterations = 0;
};

Solved solve(Scene scene) {
  Driver driver(std::move(scene));
  const Report& report = driver.solve();
  if (!report.converged())
    throw Error(Exit::not_converged, fmt::format("not solved: {}", report.steps.empty() ? "" : report.reason()));
  Solved out;
  for (const StepReport& step : report.steps) out.iterations += step.summary.iterations;
  for (std::size_t body = 0; body < driver.bodies(); ++body) out.u.push_back(driver.solution(body));
  return out;
}

Comparison compare(const Scene& scene) {
  const Solved own = solve(scene);
  Scene other = scene;
  other.solver.method = "pgs";
  other.solver.max_iterations = 1000000;
  Comparison out;
  out.iterations = own.iterations;
  const Solved plain = solve(other);
  out.gauss_seidel = plain.iterations;
  double size = 0, off = 0;
  for (std::size_t body = 0; body < own.u.size(); ++body)
    for (std::size_t i = 0; i < own.u[body].size(); ++i) {
      size = std::fmax(size, std::fabs(plain.u[body][i]));
      off = std::fmax(off, std::fabs(own.u[body][i] - plain.u[body][i]));
    }
  out.difference = size > 0 ? off / size : off;
  return out;
}

/// A unit square or cube above a height.
std::string block(const char* name, bool plane, int bottom) {
  return plane ? fmt::format(
                     "[[body]]\nname = \"{}\"\nshape = \"rectangle\"\nfrom = [0, {}]\nto = [1, {}]\n"
                     "cells = [2, 2]\n",
                     name, bottom, bottom + 1)
               : fmt::format(
                     "[[body]]\nname = \"{}\"\nshape = \"box\"\nfrom = [0, 0, {}]\nto = [1, 1, {}]\n"
                     "cells = [2, 2, 2]\n",
                     name, bottom, bottom + 1);
}

/// A membrane that its load pulls to both sides, a block that is pressed down and aside, or two of these.
template <int B>
std::string scene_text(const Subject& subject, const std::filesystem::path& folder, int space) {
  const bool plane = space == 2;
  std::string text = fmt::format("[plugins]\npath = [\"{}\"]\n[solver]\ntolerance = 1e-9\n", folder.string());
  const std::string more = B == 1 ? "equation = \"diffusion\"\n" : "order = 1\nyoung = 1\npoisson = 0.3\n";
  const std::string obstacle = fmt::format("[[obstacle]]\ntype = \"{}\"\nbody = \"a\"\n", subject.id());
  text += block("a", plane, 0) + more;
  if (B == 1)
    return text +
           "[[fix]]\nbody = \"a\"\non = \"left\"\nvalue = [0]\n[[load]]\nbody = \"a\"\nvalue = "
           "[\"3 * sin(7 * x * y)\"]\n" +
           obstacle;
  text += fmt::format("[[fix]]\nbody = \"a\"\non = \"top\"\nvalue = [0.02, {}-0.05]\n", plane ? "" : "0.01, ");
  if (subject.type().takes_body)
    return text + block("b", plane, -1) + more +
           fmt::format("[[fix]]\nbody = \"b\"\non = \"bottom\"\nvalue = [0, 0{}]\n", plane ? "" : ", 0") + obstacle +
           "on = \"bottom\"\nother = \"b\"\nother_on = \"top\"\n";
  text += obstacle + "on = \"bottom\"\n";
  if (!subject.type().takes_shape || subject.is_given("shape")) return text;
  return text + (plane ? "shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n"
                       : "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n");
}

}  // namespace

Comparison compare_with_gauss_seidel(const std::filesystem::path& file, const std::filesystem::path& library) {
  const std::string folder = std::filesystem::absolute(library).parent_path().string();
  const std::vector<std::string> overrides{fmt::format("plugins.path=[\"{}\"]", folder), "solver.tolerance=1e-9"};
  return compare(read_scene(file, overrides));
}

template <int B>
Solves solve_scenes(const Subject& subject, const Values& values, const std::filesystem::path& folder, int space) {
  Solves out;
  const std::string text = scene_text<B>(subject, folder, space);
  int coarse = 0;
  const int first = space == 2 ? 1 : 0;
  for (int refinements = first; refinements < first + 3; ++refinements) try {
      std::vector<std::string> overrides{fmt::format("refine.uniform={}", refinements)};
      for (const Values* all : {&values, &subject.given()})
        for (const std::string& value : *all) overrides.push_back("obstacle.0." + value);
      out.example = fmt::format("a {} of {} cells each way", space == 2 ? "square" : "cube", 2 << refinements);
      const Comparison found = compare(parse_scene(text, "scene of the kit", ".", overrides));
      if (out.agrees.empty() && !(found.difference <= agreement))
        out.agrees =
            fmt::format("the solution differs from that of Gauss-Seidel steps by {:.2g} of it", found.difference);
      if (refinements == first) coarse = found.iterations;
      if (found.iterations > 2 * coarse + 10)
        out.cycles = fmt::format("{} iterations, and {} at the coarsest of three sizes", found.iterations, coarse);
      if (!out.agrees.empty() || !out.cycles.empty()) return out;
    } catch (const Error& error) {
      if (error.status() == Exit::plugin || error.status() == Exit::not_converged)
        out.agrees = error.what();
      else
        out.note = error.what();
      return out;
    }
  return out;
}

template Solves solve_scenes<1>(const Subject&, const Values&, const std::filesystem::path&, int);
template Solves solve_scenes<2>(const Subject&, const Values&, const std::filesystem::path&, int);
template Solves solve_scenes<3>(const Subject&, const Values&, const std::filesystem::path&, int);

}  // namespace signorini::conformance
