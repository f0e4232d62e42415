#include "apps/signorini/nested_solver.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amg/hierarchy.hpp"
#include "amg/nested_start.hpp"
#include "apps/signorini/interrupt.hpp"
#include "core/base/error.hpp"
#include "core/fem/nested.hpp"
#include "core/mesh/stretch.hpp"
#include "core/solver/solve.hpp"

namespace signorini {
namespace {

/// Vectors on the coarsest mesh above which the hierarchy goes on below it.
constexpr Index large_coarsest_mesh = 1000;

/// Stretching of cells (core/mesh/stretch.hpp) from which on algebraic levels from the finest mesh take about
/// half the cycles of nested meshes or less, in about the same time: their set-up costs more for elastic bodies.
constexpr double stretched_scalar = 1.45, stretched_elastic = 1.7;
constexpr double many = 0.1;  // part of the cells so stretched

/// Obstacles that could not be made part of the problem may be what holds the body.
template <int B>
[[noreturn]] void throw_unbounded(const std::string& origin, const Solution<B>& solution) {
  if (solution.discretization.dropped.empty())
    throw Error(Exit::no_solution, fmt::format("{}: {}", origin, solution.summary.reason));
  input_error(origin, solution.summary.reason +
                          " but perhaps obstacles that meet others in dependent or nearly parallel directions at one "
                          "vertex; such obstacles are not available in this version");
}

template <int D>
bool is_stretched(const Mesh<D>& mesh, int block) {
  return stretched_part(mesh, block == 1 ? stretched_scalar : stretched_elastic) > many;
}

/// Of an elastic body.
template <int D, int B>
NearNullSpace near_null_space(const Mesh<D>& mesh) {
  if constexpr (B == 1) return {};
  std::vector<double> coordinates;
  for (const Point<D>& x : mesh.points) coordinates.insert(coordinates.end(), x.begin(), x.end());
  return rigid_body_modes<D>(coordinates);
}

}  // namespace

std::optional<Coarsening> coarsening_below(const Scene::Solver& options, int block, Index vertices) {
  if (!options.algebraic || vertices <= large_coarsest_mesh) return {};
  const Coarsening wanted = algebraic_settings(options).coarsening;
  if (wanted != Coarsening::automatic) return wanted;
  return block > 1 ? Coarsening::aggregation : Coarsening::classical;
}

template <int D>
std::size_t first_mesh(const MeshHierarchy<D>& hierarchy, const Scene::Solver& options, int block) {
  const std::size_t finest = hierarchy.levels.size() - 1;
  if (options.hierarchy != "auto") return options.hierarchy == "matrix" ? finest : 0;
  if (!options.algebraic) return 0;
  return is_stretched(hierarchy.levels.front(), block) ? finest : 0;
}

template <int D, int B>
NestedSolver<D, B>::NestedSolver(const MeshHierarchy<D>& hierarchy, const Scene::Solver& options,
                                 const Registry& registry, const Progress& progress, Times& times)
    : hierarchy_(hierarchy),
      options_(options),
      first_(first_mesh(hierarchy, options, B)),
      registry_(registry),
      progress_(progress),
      times_(times),
      monitor_([this](const IterationRecord& record) {
        progress_.cycle(record);
        return !interrupted();
      }) {
  Stopwatch watch;
  if (first_ == 0) prolongations_ = prolongations(hierarchy);
  times_.setup += watch.elapsed();
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::discretize_level(const Model<B>& model, std::size_t level) {
  stop_if_interrupted();
  Stopwatch watch;
  const Mesh<D>& mesh = hierarchy_.levels[level];
  progress_.phase(fmt::format("level {}: {} vertices", level, mesh.vertices()));
  Solution<B> solution{discretize<D, B>(mesh, model), {}, {}};
  solution.x = solution.discretization.problem.start;
  times_.assemble += watch.elapsed();
  return solution;
}

template <int D, int B>
void NestedSolver<D, B>::continue_algebraically(DiscreteProblem<B>& coarsest) {
  if (continued_) return;
  continued_ = true;
  const auto coarsening = coarsening_below(options_, B, coarsest.A.size());
  if (!coarsening) return;
  Stopwatch watch;
  const auto transfer = [this] { return registry_.create<Transfer<B>>("transfer", options_.transfer); };
  AlgebraicSettings settings = algebraic_settings(options_);
  settings.stretched = is_stretched(hierarchy_.levels.front(), B);
  auto modes =
      *coarsening == Coarsening::aggregation ? near_null_space<D, B>(hierarchy_.levels[first_]) : NearNullSpace{};
  const auto aggregator = registry_.create<Aggregator>("aggregates", options_.aggregates);
  auto below = algebraic_hierarchy<B>(coarsest, transfer, enough_vectors, settings, std::move(modes), *aggregator);
  algebraic_ = below.prolongations.size();
  prolongations_.insert(prolongations_.begin(), std::make_move_iterator(below.prolongations.begin()),
                        std::make_move_iterator(below.prolongations.end()));
  galerkin_ = std::move(below.matrices);
  coarsest.galerkin = galerkin_;
  times_.setup += watch.elapsed();
}

/// On nested meshes the matrix of the coarser one is the product that the solver would compute: it takes it over.
template <int D, int B>
void NestedSolver<D, B>::share_matrix(Solution<B>& coarse, std::size_t level, DiscreteProblem<B>& problem) {
  Stopwatch watch;
  const std::size_t below = algebraic_ + level - first_ - 1;
  DiscreteProblem<B>& shared = coarse.discretization.problem;
  if (galerkin_.size() == below && is_galerkin(shared, prolongations_[below], problem)) {
    galerkin_.push_back({std::move(shared.A), std::move(shared.fixed), false});
    problem.galerkin = galerkin_;
  } else {
    galerkin_.clear();
  }
  times_.setup += watch.elapsed();
}

/// The start comes from the next coarser mesh, below all meshes from algebraic levels.
template <int D, int B>
Solution<B> NestedSolver<D, B>::begin_level(const Model<B>& model, std::size_t level, Solution<B>& coarse) {
  Solution<B> solution = discretize_level(model, level);
  DiscreteProblem<B>& problem = solution.discretization.problem;
  if (!coarse.x.empty()) {
    solution.x =
        interpolate(coarse.discretization.problem, coarse.x, prolongations_[algebraic_ + level - first_ - 1], problem);
    share_matrix(coarse, level, problem);
  } else if (level == first_ && options_.start == "nested") {
    continue_algebraically(problem);
    Stopwatch watch;
    solution.x = nested_start(problem, std::span(prolongations_).first(algebraic_), options_, registry_, monitor_);
    times_.solve += watch.elapsed();
  }
  return solution;
}

template <int D, int B>
void NestedSolver<D, B>::solve_level(const Model<B>& model, std::size_t level, const SolverOptions& options,
                                     Solution<B>& solution) {
  stop_if_interrupted();
  if (level == first_) continue_algebraically(solution.discretization.problem);
  const bool finest = level + 1 == hierarchy_.levels.size();
  try {
    solution.summary = signorini::solve<B>(solution.discretization.problem,
                                           std::span(prolongations_).first(algebraic_ + level - first_), solution.x,
                                           options, registry_, monitor_);
  } catch (const Error& error) {  // the solver knows no scene
    throw Error(error.status(), fmt::format("{}: {}", model.origin, error.what()));
  }
  solution.discretization.problem.galerkin = {};
  if (finest) galerkin_.clear();
  solution.summary.finest_level = static_cast<int>(level - first_);
  times_.setup += solution.summary.setup_seconds;
  times_.solve += solution.summary.solve_seconds;
  stop_if_interrupted();
  if (solution.summary.outcome == Outcome::unbounded) throw_unbounded(model.origin, solution);
}

/// What fails on a coarse level (a selection without faces there, too few nodes to hold the body) may well hold on the
/// finest one, which alone decides: such a level gives no start.
template <int D, int B>
bool NestedSolver<D, B>::try_level(const Model<B>& model, std::size_t level, Solution<B>& coarse) {
  try {
    const SolverOptions options = for_a_start<B>(options_, !coarse.x.empty());
    Solution<B> solution = begin_level(model, level, coarse);
    solve_level(model, level, options, solution);
    coarse = std::move(solution);
    return true;
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted) throw;
    progress_.phase(fmt::format("level {} gives no start: {}", level, error.what()));
    return false;
  }
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve(const Model<B>& model) {
  const std::size_t finest = hierarchy_.levels.size() - 1;
  Solution<B> coarse;
  if (options_.start == "nested")
    for (std::size_t level = first_; level < finest; ++level)
      if (!try_level(model, level, coarse)) coarse = {}, galerkin_.clear();
  Solution<B> solution = begin_level(model, finest, coarse);
  coarse = {};
  solve_level(model, finest, options_, solution);
  return solution;
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_from(const Model<B>& model, const std::vector<double>& start) {
  const std::size_t finest = hierarchy_.levels.size() - 1;
  Solution<B> solution = discretize_level(model, finest);
  solution.x = to_local(solution.discretization.problem, start);
  solve_level(model, finest, options_, solution);
  return solution;
}

template std::size_t first_mesh(const MeshHierarchy<2>&, const Scene::Solver&, int);
template std::size_t first_mesh(const MeshHierarchy<3>&, const Scene::Solver&, int);
template class NestedSolver<2, 1>;
template class NestedSolver<3, 1>;
template class NestedSolver<2, 2>;
template class NestedSolver<3, 3>;

}  // namespace signorini
