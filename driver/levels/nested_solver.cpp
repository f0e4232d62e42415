#include "driver/levels/nested_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amg/coarsening/hierarchy.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/base/release.hpp"
#include "core/base/stopwatch.hpp"
#include "core/constraints/admissible_sets.hpp"
#include "core/constraints/check_functionals.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/fem/conditions/walls.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/fem/incompressible/pressure_load.hpp"
#include "core/mesh/families.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/sticking.hpp"
#include "driver/levels/level_choice.hpp"
#include "driver/levels/moved_problem.hpp"
#include "driver/levels/near_null_space.hpp"
#include "driver/motions/loose_body.hpp"
#include "methods/nested_iteration.hpp"
#include "methods/solve.hpp"

namespace signorini {
namespace {

/// What rounding of the assembled matrix does, in units of what it does to products with it: an entry comes from about
/// so many operations. (Cantilevers from 100:1 to 1000:1 in six units of length each differ by 2 to 7 of them.)
constexpr double of_assembly = 6;

/// Friction opposes the motion since the last step, of which u is the displacement, relative to the obstacle, whose own
/// motion is there already.
template <int B>
void remember(const std::vector<double>& u, Discretization<B>& discretization) {
  Constraints<B>& c = discretization.problem.constraints;
  if (!c.last.empty()) count_from(to_local(discretization.problem, u), c);
  for (HeldBound<B>& held : discretization.held)
    for (int k = 0; k < B; ++k) held.last[k] += u[Offset{held.bound.vertex} * B + k];
}

template <int D, int B>
std::vector<Prolongation> between_meshes(const MeshLevels<D, B>& levels, std::size_t first) {
  std::vector<Prolongation> between;
  for (std::size_t k = first + 1; k < levels.size(); ++k)
    between.push_back(prolongation(*levels[k].refinement, levels[k - 1].nodes, levels[k].nodes));
  return between;
}

/// What springs exert on a body that has moved by `way`, local coordinates, in global ones.
template <int D, int B>
std::vector<double> spring_load(const Nodes<D>& nodes, const Model<B>& model, const DiscreteProblem<B>& problem,
                                const std::vector<double>& way) {
  if (way.empty() || model.springs.empty()) return {};
  std::vector<double> forces(way.size());
  add_spring_forces(nodes, model, to_global(problem, way), forces);
  return forces;
}

template <int D, int B>
using LoadOf = std::conditional_t<D == B, PressureLoad<D>, NoPressure>;

}  // namespace

template <int D, int B>
NestedSolver<D, B>::NestedSolver(const MeshHierarchy<D>& hierarchy, const Scene::Solver& options,
                                 const Registry& registry, const Progress& progress, Times& times,
                                 std::vector<Nodes<D>> nodes)
    : levels_(hierarchy, nodes.empty() ? nodes_of(hierarchy) : std::move(nodes)),
      options_(options),
      pairs_(levels_),
      registry_(registry),
      progress_(progress),
      times_(times),
      monitor_([this](const IterationRecord& record) {
        progress_.cycle(record);
        return !progress_.is_ended();
      }),
      matrices_(0, 0, {}) {
  choose_levels();
}

/// Which meshes are levels depends on all of them and on how the hierarchy is to be. Of others nothing is kept.
template <int D, int B>
void NestedSolver<D, B>::choose_levels() {
  if (chosen_for_ == options_.hierarchy) return;
  const Stopwatch watch;
  chosen_for_ = options_.hierarchy;
  const std::vector<const Mesh<D>*> meshes = levels_.meshes();
  first_ = first_mesh<D>(meshes, options_, B, nodes().order());
  factorised_ = factorised_meshes<D>(meshes, options_, B);
  matrices_ = LevelMatrices<B>(first_, factorised_, between_meshes(levels_, first_));
  continued_ = false;
  pairs_.begin_at(first_);
  for (MeshLevel<D, B>& level : levels_) level.kept.reset();
  times_.setup += watch.elapsed();
}

/// What there is to come begins anew, see extrapolated().
template <int D, int B>
void NestedSolver<D, B>::forget_way() {
  earlier_.clear();
  earlier_t_ = infinity;
}

template <int D, int B>
void NestedSolver<D, B>::append(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes) {
  spared_ = nullptr;
  forget_way();
  levels_.append(mesh, refinement, std::move(nodes));
  chosen_for_.clear();
  choose_levels();
}

template <int D, int B>
void NestedSolver<D, B>::drop_finest() {
  spared_ = nullptr;
  forget_way();
  levels_.drop_finest();
  chosen_for_.clear();
  choose_levels();
}

template <int D, int B>
void NestedSolver<D, B>::replace_finest(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes) {
  spared_ = nullptr;
  forget_way();
  levels_.replace_finest(mesh, refinement, std::move(nodes));
  chosen_for_.clear();
  choose_levels();
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::discretize_level(const Model<B>& model, std::size_t level) {
  progress_.stop_if_interrupted();
  Stopwatch watch;
  MeshLevel<D, B>& here = levels_[level];
  progress_.phase(fmt::format("level {}: {} vertices", level, here.mesh->vertices()));
  Solution<B> solution;
  if (auto renewed = renew_level(model, level)) {
    solution.discretization = std::move(*renewed);
  } else {
    here.changed = true;
    solution.discretization = discretize<D, B>(here.nodes, model, here.pairs);
    Assemblies& count = times_.assemblies;
    ++count.stiffness, ++count.load, ++count.constraints;
  }
  if (here.changed) find_pressure_space(model, level);
  if (level == first_ && here.changed) matrices_.forget_products();
  DiscreteProblem<B>& problem = solution.discretization.problem;
  if (model.follows && !here.before.u.empty()) remember(here.before.u, solution.discretization);
  rest_where_prescribed(problem);
  if (model.follows) here.before.numbers.hand_to(solution.discretization.functional, problem.constraints);
  problem.cheap_to_factorise = level < factorised_;
  problem.spent = spent_;
  if (!here.force.empty()) {
    add_force(here.force, 1, solution.discretization.load);
    place_loads(solution.discretization);
  }
  solution.x = problem.start;
  if (!solution.discretization.functional.empty()) {
    const LooseBody<D, B> body(here.nodes, model, solution.discretization);
    problem.loose = here.before.u.empty() && body.needs_friction();
    body.require_minimum();  // where friction is too weak coarse meshes tell it early
  }
  times_.assemble += watch.elapsed();
  return solution;
}

template <int D, int B>
void NestedSolver<D, B>::take_contact(std::vector<std::shared_ptr<const PairedBodies<B>>> pairs,
                                      std::vector<std::vector<double>> forces) {
  pairs_.give(std::move(pairs));
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    MeshLevel<D, B>& level = levels_[k];
    if (level.kept) add_force(level.force, -1, level.kept->discretization.load);  // back to the model's own
    level.force = forces.empty() ? std::vector<double>{} : std::move(forces[k]);
  }
}

template <int D, int B>
void NestedSolver<D, B>::drop_algebraic_levels() {
  matrices_.drop_algebraic();
  continued_ = false;
}

/// A force that acts at nodes beside the model's loads.
template <int D, int B>
void NestedSolver<D, B>::add_force(const std::vector<double>& force, double sign, std::vector<double>& load) {
  for (std::size_t k = 0; k < force.size(); ++k) load[k] += sign * force[k];
}

/// From what the last solve left, if that is all there.
template <int D, int B>
std::optional<Discretization<B>> NestedSolver<D, B>::renew_level(const Model<B>& model, std::size_t level) {
  MeshLevel<D, B>& here = levels_[level];
  auto kept = std::exchange(here.kept, std::nullopt);
  if (!kept) return {};
  DiscreteProblem<B>& problem = kept->discretization.problem;
  if (level + 1 < levels_.size()) {
    GalerkinMatrix<B>* matrix = matrices_.of(level);
    if (!matrix) return {};
    problem.A = std::move(matrix->A);
    problem.fixed = std::move(matrix->off);
  }
  const Assembled assembled = renew(here.nodes, kept->model, model, kept->discretization, here.pairs);
  here.changed = !assembled.same_matrix();
  times_.assemblies.stiffness += assembled.stiffness;
  times_.assemblies.load += assembled.load;
  ++times_.assemblies.constraints;
  return std::move(kept->discretization);
}

/// Meshes that are no refinements have none: starts on them know the displacements' part of the material alone.
template <int D, int B>
void NestedSolver<D, B>::find_pressure_space(const Model<B>& model, std::size_t level) {
  MeshLevel<D, B>& here = levels_[level];
  here.pressure_space.reset();
  if constexpr (D == B) {
    if (model.pressure == Pressure::none || here.mesh->families.empty()) return;
    PressureSpace<D> space = signorini::pressure_space(here.nodes, model);
    if (space.size > 0) here.pressure_space.emplace(std::move(space));
  }
}

/// A pressure of the next coarser mesh on this one; zero where that has none.
template <int D, int B>
std::vector<double> NestedSolver<D, B>::refined_pressure(std::size_t level, const std::vector<double>& coarse) const {
  if constexpr (D == B) {
    const MeshLevel<D, B>&here = levels_[level], &below = levels_[level - 1];
    if (here.pressure_space && !coarse.empty() && below.pressure_space)
      return prolongate(*below.pressure_space, *below.mesh, coarse, *here.refinement, *here.pressure_space, *here.mesh);
  }
  return {};
}

namespace {

/// What is new in every solve.
template <int B>
void release_constraints(Discretization<B>& discretization) {
  DiscreteProblem<B>& problem = discretization.problem;
  for (auto* values : {&problem.b, &problem.start}) release(*values);
  for (auto* obstacles : {&discretization.lower_obstacle, &discretization.upper_obstacle}) release(*obstacles);
  release(discretization.tied);
  problem.constraints = {};
}

}  // namespace

template <int D, int B>
void NestedSolver<D, B>::keep(const Model<B>& model, MeshLevel<D, B>& level, Solution<B>& coarse) {
  if (coarse.x.empty()) return;
  release_constraints(coarse.discretization);
  level.kept.emplace(typename MeshLevel<D, B>::Kept{model, std::move(coarse.discretization)});
}

template <int D, int B>
void NestedSolver<D, B>::take_back(const Model<B>& model, Discretization<B> last) {
  release_constraints(last);
  levels_.finest().kept.emplace(typename MeshLevel<D, B>::Kept{model, std::move(last)});
}

template <int D, int B>
void NestedSolver<D, B>::forget_matrices() {
  for (MeshLevel<D, B>& level : levels_) level.kept.reset();
  drop_algebraic_levels();
}

template <int D, int B>
void NestedSolver<D, B>::continue_algebraically(DiscreteProblem<B>& coarsest) {
  if (continued_) return;
  continued_ = true;
  if (factorised_ > 0) return;
  const auto coarsening = coarsening_below(options_, B, coarsest.A.size());
  if (!coarsening) return;
  Stopwatch watch;
  const auto transfer = [this] { return registry_.create<Transfer<B>>("transfer", options_.transfer); };
  AlgebraicSettings settings = algebraic_settings(options_);
  settings.stretched = is_stretched(*levels_[0].mesh, B);
  auto modes = *coarsening == Coarsening::aggregation
                   ? near_null_space<D, B>(levels_[first_].nodes, coarsest.jumps.get())
                   : NearNullSpace{};
  const auto aggregator = registry_.create<Aggregator>("aggregates", options_.aggregates);
  auto below = algebraic_hierarchy<B>(coarsest, transfer, enough_vectors, settings, std::move(modes), *aggregator);
  matrices_.continue_below(std::move(below.prolongations), std::move(below.matrices));
  ++times_.assemblies.hierarchies;
  times_.setup += watch.elapsed();
}

template <int D, int B>
void NestedSolver<D, B>::solve_level(const Model<B>& model, std::size_t level, const SolverOptions& options,
                                     const LooseBody<D, B>* body, Solution<B>& solution) {
  progress_.stop_if_interrupted();
  const MeshLevel<D, B>& here = levels_[level];
  if (level == first_) continue_algebraically(solution.discretization.problem);
  solution.discretization.problem.galerkin = matrices_.products_below(level);
  std::vector<double> way = body ? body->fall(solution.x) : std::vector<double>{};
  const std::vector<double> of_springs = spring_load(here.nodes, model, solution.discretization.problem, way);
  MovedProblem<B> moved(solution.discretization, std::move(way), of_springs, solution.x, solution.pressure);
  std::optional<LoadOf<D, B>> pressure;
  if constexpr (D == B) {
    if (here.pressure_space) {
      pressure.emplace(*here.pressure_space, solution.discretization, std::move(solution.pressure),
                       thermal_volume(here.nodes, model, *here.pressure_space));
      solution.discretization.problem.following = &*pressure;
    }
  }
  const ModelPlaces<D, B> places(here.nodes, model);
  const std::vector<Index>& acts = solution.discretization.functional;
  probe_functionals(places, solution.discretization.problem, acts, solution.x);
  const bool result = level + 1 == levels_.size() && options.tolerance <= options_.tolerance;
  progress_.solving({result, options.tolerance, 1 << levels_.finest().mesh->mirrors.size()});
  try {
    std::optional<ElementsAside<D>> aside;
    if (spared_ && level + 1 == levels_.size()) aside.emplace(*spared_);
    solution.summary = signorini::solve<B>(solution.discretization.problem, matrices_.below(level), solution.x, options,
                                           registry_, monitor_);
  } catch (const Error& error) {  // the solver knows no scene
    if (error.status() != Exit::interrupted) {
      blame_functionals(places, solution.discretization.problem, acts, solution.x);
      if (!std::ranges::all_of(solution.x, [](double v) { return std::isfinite(v); }))
        check_admissible_sets(places, solution.discretization.problem, extent(here.nodes.mesh()), true);
    }
    throw Error(error.status(), fmt::format("{}: {}", model.origin, error.what()));
  }
  if (spared_) restore_ends(*spared_);
  check_functionals(places, solution.discretization.problem, acts, solution.x);
  solution.summary.add_rounding(of_assembly * solution.summary.rounding_error, options.tolerance);
  solution.summary.add_rounding(moved.back(), options.tolerance);
  if constexpr (D == B) {
    if (pressure) {
      pressure->apply();
      pressure->press_on_prescribed();
      solution.pressure = pressure->values();
    }
  }
  solution.discretization.problem.following = nullptr;
  solution.discretization.problem.galerkin = {};
  solution.summary.finest_level = static_cast<int>(level - first_);
  times_.setup += solution.summary.setup_seconds;
  times_.solve += solution.summary.solve_seconds;
  if (!result) progress_.stop_if_interrupted();  // else what there is may be kept
  if (solution.summary.outcome == Outcome::unbounded)
    throw Error(Exit::no_solution, fmt::format("{}: {}", model.origin, solution.summary.reason));
}

/// What soft springs alone hold has little energy, which cycles neither see nor take away: it is found by itself. Where
/// that changes more than the tolerance cycles find what else depends on it.
template <int D, int B>
void NestedSolver<D, B>::rest_on_springs(const Model<B>& model, const SolverOptions& options,
                                         const LooseBody<D, B>& body, Solution<B>& solution) {
  constexpr int enough = 5;
  for (int k = 0; k < enough && solution.summary.converged() && !progress_.is_ended(); ++k) {
    const double moved = body.rest_on_springs(solution.x);
    const DiscreteProblem<B>& problem = solution.discretization.problem;
    std::vector<double> r(solution.x.size());
    residual<B>(problem.A, solution.x.data(), problem.b.data(), r.data());
    if (moved <= options.tolerance * std::sqrt(energy_norm_squared(problem, solution.x, r))) return;
    std::vector<Stage> before = std::move(solution.summary.stages);
    place_loads(solution.discretization);
    solve_level(model, levels_.size() - 1, options, &body, solution);
    solution.summary.put_in_front(std::move(before));
  }
}

/// Whether there is a solution at all shows before, and where it is not unique which one is meant afterwards.
template <int D, int B>
void NestedSolver<D, B>::solve_finest(const Model<B>& model, SolverOptions options, Solution<B>& solution) {
  const LooseBody<D, B> body(nodes(), model, solution.discretization);
  const bool moves = solution.discretization.functional.empty();  // else friction may hold what bounds alone do not
  if (moves) body.require_minimum();
  if (may_fall_back())
    options.max_iterations =
        std::min(options.max_iterations, moves ? automatic::attempt(automatic::Kind::levels_of_matrix).most_steps
                                               : automatic::patience_with_friction);
  solve_level(model, levels_.size() - 1, options, moves ? &body : nullptr, solution);
  while (solution.summary.converged() && !progress_.is_ended() && pair_more(model, solution)) {
    std::vector<Stage> before = std::move(solution.summary.stages);
    solve_level(model, levels_.size() - 1, options, nullptr, solution);
    solution.summary.put_in_front(std::move(before));
  }
  if (moves) rest_on_springs(model, options, body, solution);
  if (solution.summary.converged()) solution.undetermined = body.settle(solution.x);
  if (!moves && !body.held() && solution.summary.converged() && body.is_far_away(solution.x)) {
    solution.summary.outcome = Outcome::stuck;
    solution.summary.reason =
        "friction does not hold the body against the loads: it would come to rest only so far away that linearised "
        "contact means nothing there";
  }
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::start_and_solve(const Model<B>& model) {
  const std::size_t finest = levels_.size() - 1;
  dropped_.clear();
  if (spared_) restore_elements(*spared_);  // the last solve may have left some without them
  for (MeshLevel<D, B>& level : levels_) level.now = {};
  pair_levels(model);
  const JointPressure<D, B> joints(nodes(), model);
  Spreading spreading(levels_[finest].before.wetted.empty() ? joints.nowhere() : levels_[finest].before.wetted);
  JointLoad<B> in_joints;
  if (!pairs_.given()) in_joints = fill_joints(joints, spreading.now(), nullptr);
  std::optional<Solution<B>> begun;
  const bool near = begin_near(model, begun);
  Solution<B> coarse;
  if (options_.start == "nested" && !near) coarse = solve_coarser_meshes(model);
  if (!continued_ && first_ < finest) choose_levels_below(model);
  Solution<B> solution = near ? std::move(*begun) : begin_level(model, finest, coarse, std::move(begun));
  coarse = {};
  if (finest == first_) come_near(model, solution);
  solution.joints = std::move(in_joints);
  if (joints.none())
    solve_finest(model, options_, solution);
  else
    solve_open(model, joints, spreading, solution);
  levels_[finest].now.t = model.t;
  followed_ = model.follows;
  levels_[finest].now.wetted = spreading.now();
  levels_[finest].now.numbers = {solution.discretization.problem, solution.discretization.functional, solution.x};
  levels_[finest].now.pressure = solution.pressure;
  solution.summary.put_in_front(std::exchange(dropped_, {}));
  return solution;
}

template <int D, int B>
void NestedSolver<D, B>::accept() {
  pairs_.accept();
  LevelSolution<B>& last = levels_.finest().before;
  earlier_ = followed_ ? std::move(last.u) : std::vector<double>();
  earlier_t_ = followed_ ? last.t : 0;
  for (MeshLevel<D, B>& level : levels_) level.before = std::exchange(level.now, {});
}

template class NestedSolver<2, 1>;
template class NestedSolver<3, 1>;
template class NestedSolver<2, 2>;
template class NestedSolver<3, 3>;

}  // namespace signorini
