#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "amg/registration.hpp"
#include "driver/components.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/reports/results.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "tests/support/on_mesh.hpp"

/// Scenes solved as `signorini solve` does it, with all that a test wants to look at.
namespace signorini::test {

using std::numbers::pi;

inline const std::filesystem::path shipped_scenes = std::filesystem::path(SIGNORINI_SOURCE_DIR) / "apps/scenes";

template <int D, int B>
struct Run {
  MeshHierarchy<D> meshes;
  int order;
  Model<B> model;
  Solution<B> solution;
  Results<D, B> results;

  const Mesh<D>& mesh() const { return meshes.finest(); }
  Nodes<D> nodes() const { return Nodes<D>(mesh(), order); }
  const Summary& summary() const { return solution.summary; }
  const std::vector<double>& u() const { return results.u; }
  const ContactSummary<B>& contact(int obstacle = 0) const { return results.contact.obstacles[obstacle]; }
  const DiscreteProblem<B>& problem() const { return solution.discretization.problem; }
};

template <int D, int B>
Run<D, B> run(const Scene& scene) {
  Registry registry = solver_components();
  load_plugins(scene, registry);
  const Progress quiet;
  Times times;
  const int order = scene.bodies[0].order;
  Run<D, B> out{build_hierarchy<D>(scene, B), order, build_model<B>(scene, D, registry, 1), {}, {}};
  NestedSolver<D, B> solver(out.meshes, scene.solver, registry, quiet, times, nodes_of(out.meshes, order));
  out.solution = solver.solve(out.model);
  out.results = results<D, B>(out.nodes(), out.model, out.solution);
  EXPECT_TRUE(out.summary().converged()) << scene.title << ": " << out.summary().reason;
  return out;
}

/// @param text a scene; file names in it are absolute
template <int D, int B>
Run<D, B> run(const std::string& text, std::vector<std::string> overrides = {}) {
  return run<D, B>(parse_scene(text, "test.toml", ".", overrides));
}

/// A scene that is shipped, with linear elements unless the overrides say otherwise: on a mesh with as
/// many unknowns as its own quadratic ones have, unless they say so, too.
inline Scene shipped(const std::string& file, std::vector<std::string> overrides) {
  const bool refined = std::ranges::any_of(overrides, [](const auto& o) { return o.starts_with("refine.uniform="); });
  overrides.insert(overrides.begin(), "body.0.order=1");
  Scene scene = read_scene(shipped_scenes / file, overrides);
  const Scene::Body& body = scene.bodies[0];
  if (!refined && body.order == 1 && body.equation == Scene::Equation::elasticity) ++scene.refine.uniform;
  return scene;
}

template <int D, int B>
Run<D, B> run_shipped(const std::string& file, std::vector<std::string> overrides) {
  return run<D, B>(shipped(file, std::move(overrides)));
}

inline std::string uniform(int refinements) { return "refine.uniform=" + std::to_string(refinements); }

/// Prints a line when the environment asks to SHOW what the tests measure.
template <class... Values>
void show(fmt::format_string<Values...> format, Values&&... values) {
  if (std::getenv("SHOW")) fmt::print(format, std::forward<Values>(values)...);
}

/// Errors on meshes of which each is twice as fine as the one before.
struct Errors {
  std::vector<double> value;

  void add(double error) { value.push_back(error); }
  /// Between the two finest meshes; 0 with a single one.
  double last_order() const { return value.size() < 2 ? 0 : std::log2(value[value.size() - 2] / value.back()); }
  double mean_order() const { return std::log2(value.front() / value.back()) / static_cast<double>(value.size() - 1); }
  void expect_falling() const {
    for (std::size_t k = 0; k + 1 < value.size(); ++k) EXPECT_LT(value[k + 1], value[k]) << "after refinement " << k;
  }
};

template <int D>
double norm(const Point<D>& x) {
  double s = 0;
  for (const double v : x) s += v * v;
  return std::sqrt(s);
}

}  // namespace signorini::test
