#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "amg/registration.hpp"
#include "apps/signorini/cheaper.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/console.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/fem/incompressible/pressure_space.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/mesh/mirror.hpp"
#include "core/scene/uses_t.hpp"
#include "driver/components.hpp"
#include "driver/dirichlet_neumann.hpp"
#include "driver/levels/level_choice.hpp"
#include "driver/reports/results.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/fitting_order.hpp"
#include "driver/scene/found_pairs.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/symmetry.hpp"
#include "driver/scene/touching_bodies.hpp"
#include "driver/warnings/contact_warnings.hpp"
#include "methods/automatic.hpp"
#include "methods/solve.hpp"

namespace signorini {
namespace {

template <int D, int B>
Offset free_unknowns(const Nodes<D>& nodes, const Model<B>& model) {
  Offset count = Offset{nodes.size()} * B;
  for (const auto& fixed : collect_fixes<D, B>(nodes, model)) count -= fixed.count;
  return count;
}

template <int D>
void print_parts(const Mesh<D>& mesh) {
  say("parts of the coarsest mesh:\n");
  for (const Part& part : mesh.parts) say("  {:<16} {} faces\n", part.name, part.faces.size());
  say("  {:<16} {} faces\n", "boundary", mesh.boundary.size());
}

void print_symmetry(const std::vector<Mirror>& mirrors) {
  if (mirrors.empty()) return;
  std::string planes;
  for (const Mirror& mirror : mirrors) planes += fmt::format(" {}", plane_name(mirror));
  say("symmetry: one of {} copies is meshed, beside{}\n", 1 << mirrors.size(), planes);
}

void print_geometry(const std::vector<SurfacePiece>& pieces) {
  constexpr std::size_t most = 20;
  if (!pieces.empty()) say("geometry of the boundary:\n");
  for (std::size_t k = 0; k < std::min(most, pieces.size()); ++k) {
    const SurfacePiece& piece = pieces[k];
    std::string line =
        fmt::format("  {:<12} {:>8} faces, {} {:.2g} of its size {:.4g}", piece.kind, piece.faces,
                    piece.center.empty() ? "off the flat faces by" : "vertices off it by", piece.deviation, piece.size);
    if (!piece.center.empty()) line += fmt::format(", center [{:.6g}]", fmt::join(piece.center, ", "));
    if (piece.kind == "cone") line += fmt::format(", half angle {:.6g}", piece.second);
    if (!piece.center.empty() && piece.kind != "cone") line += fmt::format(", radius {:.6g}", piece.radius);
    if (piece.center.empty() && piece.second > 0)
      line += fmt::format(", angles up to {:.3g} degrees", piece.second * 180 / std::numbers::pi);
    say("{}\n", line);
  }
  if (pieces.size() > most) say("  and {} more\n", pieces.size() - most);
}

/// Of quadratic elements the last line tells their nodes and number.
template <int D, int B>
void print_levels(const MeshHierarchy<D>& hierarchy, int order, const Model<B>& model) {
  const std::vector<Nodes<D>> nodes = nodes_of(hierarchy, order);
  say("levels:\n");
  for (std::size_t k = 0; k < hierarchy.levels.size(); ++k) {
    const Mesh<D>& mesh = hierarchy.levels[k];
    const bool finest = k + 1 == hierarchy.levels.size();
    std::string unknowns = "no start: ";
    try {
      unknowns = fmt::format("{} unknowns", free_unknowns(nodes[k], model));
    } catch (const Error& error) {  // only the finest level has to hold the whole problem
      if (finest) throw;
      unknowns += error.what();
    }
    const bool quadratic = nodes[k].order() == 2;
    say("  {} {:>10} {} {:>10} {}  {}\n", k, mesh.vertices(), quadratic ? "nodes   " : "vertices",
        quadratic ? mesh.families.size() : mesh.elements.size(), quadratic ? "quadratic elements" : "elements",
        unknowns);
  }
}

template <int D>
void print_memory(const MeshHierarchy<D>& hierarchy, int uniform, int order, int block) {
  const HierarchySize size = hierarchy_size(hierarchy.levels.front(), uniform + order - 1);
  say("memory: about {:.3g} GB will be needed, {:.3g} GB are available\n",
      expected_memory(size, block, order == 1 ? 0 : D) / 1e9, available_memory() / 1e9);
}

/// Unknowns of the pressure of nearly incompressible material.
template <int D, int B>
Index pressure_unknowns(const Nodes<D>& nodes, const Model<B>& model) {
  if constexpr (D == B) {
    if (model.pressure != Pressure::none && !nodes.mesh().families.empty()) return pressure_space<D>(nodes, model).size;
  }
  return 0;
}

template <int D, int B>
void print_contacts(const Nodes<D>& nodes, const Scene& scene, const Scene::Body& body, const Model<B>& model,
                    const std::vector<SlaveChoice>& slaves) {
  const std::vector<int> numbers = numbers_of(scene.obstacles, body);
  std::vector<std::set<Index>> candidates(numbers.size());
  std::vector<FunctionalNumbers<B>> functionals;
  std::shared_ptr<const PairedBodies<B>> pairing;
  if constexpr (D == B) pairing = pair_bodies(nodes, model, collect_fixes(nodes, model));
  if constexpr (D == B)
    if (pairing) refuse_lost(nodes, model, *pairing);
  for (const Bound<B>& bound : collect_bounds<D, B>(nodes, model, functionals, pairing.get()))
    candidates[bound.obstacle].insert(bound.vertex);
  for (const TiedNode& tie : pairing ? pairing->ties : std::vector<TiedNode>())
    candidates[tie.obstacle].insert(tie.node);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Scene::Obstacle& obstacle = scene.obstacles[numbers[k]];
    say("obstacle {}: {}, {} {} on the finest level\n", numbers[k], obstacle.type, candidates[k].size(),
        model.obstacles[k].tied ? "tied nodes" : "candidate contact vertices");
    if (!obstacle.other.empty())
      say("  the slave is {} ({})\n", side_of(obstacle, slaves[k].exchanged), slaves[k].reason);
  }
}

void print_solver(const Scene::Solver& options, std::optional<Coarsening> below, bool meshes, int block,
                  Offset unknowns, bool cycles_only) {
  const bool aggregates = below == Coarsening::aggregation;
  say("solver: method {}\n", options.method == "auto"
                                 ? "auto: " + automatic::describe(options, aggregates, block, unknowns, cycles_only)
                                 : options.method);
  if (options.method == "pdas" || options.method == "newton") return;
  if (options.method == "pgs") {
    say("        smoother {}, on the finest mesh only\n", options.smoother);
    return;
  }
  say("        {}-cycle, {} smoothing steps before and {} after, smoother {}, coarse {}\n", options.cycle, options.pre,
      options.post, options.smoother, options.coarse);
  if (below)
    say("        levels below the {} by {}\n", meshes ? "coarsest mesh" : "finest mesh, without the coarser ones,",
        aggregates ? "aggregation, aggregates " + options.aggregates : "classical coarsening");
}

/// What is wrong somewhere in the body or with the obstacles shows in the discrete problems only. Returns the last
/// model.
/// @param slaves chosen by the first one
template <int D, int B>
Model<B> check_steps(const Scene& scene, const Registry& registry, std::size_t body, const MeshHierarchy<D>& hierarchy,
                     const Nodes<D>& nodes, std::vector<SlaveChoice>& slaves) {
  Model<B> model;
  Discretization<B> discretization;
  const bool alike = !uses_t(scene, scene.bodies[body]);
  for (const double t : scene.steps.at) {
    if (alike && t != scene.steps.at.back()) continue;
    at_step(scene, t, [&] {
      Model<B> now = build_model<B>(scene, D, registry, t, body);
      check_symmetry(hierarchy, now);
      if constexpr (D == B) {
        if (slaves.empty()) slaves = choose_slaves(Nodes(hierarchy.levels.front()), now);
        exchange_sides(slaves, now);
        check_turns(scene, body, now);
      }
      if (discretization.problem.A.size() == 0)
        discretization = discretize<D, B>(nodes, now);
      else
        renew<D, B>(nodes, model, now, discretization);
      try {
        check_method(discretization.problem, scene.solver);
      } catch (const Error& error) {  // as the solve names it
        throw Error(error.status(), fmt::format("{}: {}", now.origin, error.what()));
      }
      model = std::move(now);
    });
  }
  return model;
}

template <int D, int B>
void check(Scene& scene, const Registry& registry, std::size_t body) {
  Warnings warnings;
  const Console console(false);
  const MeshHierarchy<D> hierarchy =
      with_fitting_order(scene, body, warnings, [&] { return build_hierarchy<D>(scene, B, &warnings, console, body); });
  console.phase("check the steps");
  const int order = scene.bodies[body].order;
  const Nodes<D> nodes = nodes_of(hierarchy, order).back();
  locate_probes(hierarchy.finest(), scene, body);
  std::vector<SlaveChoice> slaves;
  const Model<B> model = check_steps<D, B>(scene, registry, body, hierarchy, nodes, slaves);
  if constexpr (D == B) refuse_unseen_overlap(nodes, model);
  print_symmetry(hierarchy.finest().mirrors);
  print_parts(hierarchy.levels.front());
  print_geometry(hierarchy.levels.front().pieces);
  say("elements: {}\n", elements_text(order, scene.bodies[body].order_chosen));
  print_levels(hierarchy, order, model);
  print_memory(hierarchy, scene.refine.uniform, order, B);
  const Index pressures = pressure_unknowns(nodes, model);
  if (pressures > 0) say("pressure: {} unknowns of its own where material is nearly incompressible\n", pressures);
  print_contacts(nodes, scene, scene.bodies[body], model, slaves);
  const Scene::Solver options = solver_options(scene, scene.bodies[body]);
  const std::vector<const Mesh<D>*> meshes = meshes_of(hierarchy);
  const std::size_t first = first_mesh<D>(meshes, options, B, order);
  const bool factorised = factorised_meshes<D>(meshes, options, B) > 0;
  const auto below = factorised ? std::nullopt : coarsening_below(options, B, hierarchy.levels[first].vertices());
  const bool functional =
      std::ranges::any_of(model.obstacles, [](const auto& term) { return term.obstacle->functional() != nullptr; });
  print_solver(options, below, first == 0, B, free_unknowns(nodes, model), functional || pressures > 0);
  print_warnings(warnings);
  print_warnings(scene_warnings(scene, hierarchy.levels.front(), body));
  print_warnings(model_warnings(scene, nodes, model, body));
  print_warnings(pair_warnings(Nodes(hierarchy.levels.front()), model));
}
}  // namespace

void check_command(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(file, overrides);
  const std::vector<FoundPair> found = add_found_pairs(scene);
  Registry registry = solver_components();
  check_components(scene, registry);
  const auto plugins = load_plugins(scene, registry);
  say("{}{}\ndimension: {}\n", file.string(), scene.title.empty() ? "" : ": " + scene.title, dimension_of(scene));
  for (const auto& plugin : plugins) say("plugin: {} {} from {}\n", plugin.id, plugin.version, plugin.file);
  for (const FoundPair& pair : found)
    say("contact: obstacle {} between {} and {}, {:.4g} apart\n", pair.obstacle, pair.body, pair.other, pair.distance);
  const Scene written = scene;
  const Stopwatch watch;
  scene.dimension = dimension_of(scene);
  scene = with_touching_bodies(scene);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    if (scene.bodies.size() > 1) say("body '{}'\n", scene.bodies[body].name);
    say("equation: {}\n", scene.bodies[body].equation == Scene::Equation::diffusion ? "diffusion" : "elasticity");
    dispatch(
        scene, [&]<int D, int B>() { check<D, B>(scene, registry, body); }, body);
  }
  constexpr double soon = 5;  // seconds: looking for symmetry takes a few times as long
  if (watch.elapsed() > soon) return;
  for (const std::string& model : cheaper_models(file, overrides, written, registry)) say("cheaper: {}\n", model);
}

}  // namespace signorini
