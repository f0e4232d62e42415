#include "driver/body_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/heap.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/recovery/rigid_gap.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/families.hpp"
#include "core/mesh/rounding_of_places.hpp"
#include "core/solver/attainable.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/levels/approach.hpp"
#include "driver/levels/slid.hpp"
#include "driver/levels/turned_friction.hpp"
#include "driver/reports/error_estimate.hpp"
#include "driver/reports/goals.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/touching_bodies.hpp"
#include "driver/warnings/balance_warnings.hpp"
#include "driver/warnings/contact_warnings.hpp"
#include "driver/warnings/strain_warnings.hpp"
#include "estimators/estimator.hpp"

namespace signorini {
namespace {

void append(Warnings& warnings, Warnings more) { std::move(more.begin(), more.end(), std::back_inserter(warnings)); }

/// Where friction holds back nothing, along obstacles, in global coordinates; empty without friction.
template <int B>
std::vector<double> rest_of_friction(const DiscreteProblem<B>& problem) {
  const Constraints<B>& c = problem.constraints;
  if (c.last.empty()) return {};
  std::vector<double> x(problem.b.size());
  for (std::size_t slot = 0; slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if (c.tangential[slot] >> k & 1u) x[Offset{c.vector[slot]} * B + k] = c.last[slot * B + k];
  return to_global(problem, std::move(x));
}

}  // namespace

template <int D, int B>
BodyRun<D, B>::BodyRun(const Scene& scene, std::size_t body, const Registry& registry, const Progress& progress,
                       Times& times, Warnings& warnings, PromisedMemory* promised,
                       std::shared_ptr<Adaptation<D>> adaptation)
    : scene_(scene),
      body_(body),
      registry_(registry),
      progress_(progress),
      times_(times),
      adaptation_(std::move(adaptation)),
      hierarchy_([&] {
        const Stopwatch watch;
        progress.phase("meshing");
        const auto meshes = [&] {
          if (!scene.refine.adaptive) return build_hierarchy<D>(scene, B, &warnings, progress, body, promised);
          if (!adaptation_)
            adaptation_ = std::make_shared<Adaptation<D>>(coarsest_mesh<D>(scene, body, B, &warnings, progress),
                                                          scene.refine.uniform, scene.bodies[body].order);
          return hierarchy_of<D>(adaptation_->mesh(), 0, scene, B, &warnings, body, promised);
        };
        auto hierarchy = meshes();
        times.mesh += watch.elapsed();
        return hierarchy;
      }()),
      solver_(hierarchy_, solver_options(scene, scene.bodies[body]), registry, progress, times,
              nodes_of(hierarchy_, scene.bodies[body].order)) {
  solver_.may_set_elements_aside(hierarchy_);
  append(warnings, scene_warnings(scene, hierarchy_.levels.front(), body));
}

template <int D, int B>
std::unique_ptr<BodyRun<D, B>> BodyRun<D, B>::refined(double growth, Warnings& warnings) const {
  const SolvedOn<D> before{hierarchy_, nodes()};
  std::vector<double> share = goal_of_element_.empty() ? estimate_of_element_ : goal_of_element_;
  for (double& of_element : share) of_element = std::abs(of_element);
  adaptation_->refine(before, share, growth);
  auto out = std::make_unique<BodyRun>(scene_, body_, registry_, progress_, times_, warnings, nullptr, adaptation_);
  out->start_from(adaptation_->carried_over(before, results_.u, {out->hierarchy_, out->nodes()}, B));
  return out;
}

template <int D, int B>
void BodyRun<D, B>::find_probes() {
  probes_ = locate_probes(mesh(), scene_, body_);
}

template <int D, int B>
void BodyRun<D, B>::begin(double t) {
  follows_ = false;
  accepted_t_ = 0;
  accepted_contact_ = {};
  accepted_bolts_.clear();
  if (body().parts.empty()) return;
  if constexpr (D == B)
    slaves_ = choose_slaves(Nodes(hierarchy_.levels.front()), build_model<B>(scene_, D, registry_, t, body_));
}

template <int D, int B>
Model<B> BodyRun<D, B>::model(const LoadStep& step) const {
  Model<B> out = build_model<B>(scene_, D, registry_, step, body_);
  if constexpr (D == B) exchange_sides(slaves_, out);
  for (std::size_t k = 0; k < out.obstacles.size(); ++k)
    if (auto& pretension = out.obstacles[k].pretension; pretension && pretension->locked)
      pretension->locked = shortening_of(static_cast<Index>(k), pretension->origin);
  return out;
}

/// In the last step that was accepted.
template <int D, int B>
double BodyRun<D, B>::shortening_of(Index obstacle, const std::string& origin) const {
  const auto bolt = std::ranges::find(accepted_bolts_, obstacle, &BoltState::obstacle);
  if (bolt == accepted_bolts_.end()) input_error(origin, "no step has pulled the bolt that is to keep its length");
  return bolt->shortening;
}

template <int D, int B>
void BodyRun<D, B>::add_warnings(double t, Warnings& warnings) const {
  const Model<B> now = model({1, 0, t});
  check_symmetry(hierarchy_, now);
  if constexpr (D == B) refuse_unseen_overlap(nodes(), now);
  append(warnings, model_warnings(scene_, nodes(), now, body_));
  const Nodes<D> coarsest(hierarchy_.levels.front());
  append(warnings, start_warnings(coarsest, now));
  append(warnings, pair_warnings(coarsest, now));
}

template <int D, int B>
void BodyRun<D, B>::add_result_warnings(const Report& report, Warnings& warnings) const {
  if (!report.converged()) return;  // what an iterate looks like that is no solution says nothing of the scene
  append(warnings, apart_warnings(scene_, body_, report, results_));
  append(warnings, chord_warnings<D, B>(model_, hierarchy_, nodes(), results_));
  if constexpr (D == B) {
    append(warnings, turn_warnings(model_, nodes(), results_));
    append(warnings, strain_warnings(model_, strains_));
  }
}

template <int D, int B>
std::vector<Stress> BodyRun<D, B>::stress() const {
  if constexpr (B == D)
    return nodal_stress(nodes(), model_, results_.u, {solver_.pressure_space(), &results_.pressure});
  return {};
}

template <int D, int B>
void BodyRun<D, B>::start_from(const std::vector<double>& u) {
  if (u.size() != mesh().points.size() * B)
    throw Error(Exit::usage,
                fmt::format("{}: a start of {} numbers, expected {}: {} for each of {} vertices", body().source.table,
                            u.size(), mesh().points.size() * B, B, mesh().points.size()));
  if (!std::ranges::all_of(u, [](double value) { return std::isfinite(value); }))
    throw Error(Exit::usage, fmt::format("{}: a start that is not finite", body().source.table));
  accepted_ = nodes().at_nodes(u, B);
}

template <int D, int B>
void BodyRun<D, B>::accept() {
  accepted_ = results_.u;
  accepted_bolts_ = results_.bolts;
  if (remembers()) accepted_contact_ = results_.contact;
  follows_ = true;
  accepted_t_ = t_;
  solver_.accept();
}

template <int D, int B>
bool BodyRun<D, B>::remembers() const {
  return std::ranges::any_of(model_.obstacles, [](const auto& term) { return term.obstacle->functional() != nullptr; });
}

template <int D, int B>
bool BodyRun<D, B>::depends_on_step() const {
  return std::ranges::any_of(model_.obstacles, [](const auto& term) { return stepping(term) != nullptr; });
}

template <int D, int B>
const std::string* BodyRun<D, B>::veto_against_cutting() const {
  for (const ObstacleTerm<B>& term : model_.obstacles)
    if (const Stepping* own = stepping(term); own && !own->may_be_cut()) return &term.origin;
  return nullptr;
}

template <int D, int B>
auto BodyRun<D, B>::doubt_of_friction(const LoadStep& step, double end, bool followed) const -> FrictionDoubt {
  constexpr const char* at_newcomers =
      "most of friction acts at nodes that came into contact in this step, and what they moved before they touched "
      "counts, too";
  if (const char* turned = signorini::doubt_of_friction(accepted_contact_, results_.contact, followed,
                                                        rounding_of_places(nodes().mesh())))
    return {turned, at_newcomers};
  if constexpr (D == B) {
    if (!remembers()) return {};
    const std::vector<double> before = follows_ ? accepted_ : std::vector<double>(results_.u.size());
    const double rest = (end - step.to) / (step.to - step.from);
    const double part = part_in_flight(nodes(), model_, accepted_contact_, results_.contact, results_.masters, before,
                                       results_.u, rest);
    if (part > 0) return {"bodies came along the surface before they touched", at_newcomers, part};
    if (!follows_ && !followed && slid() > 1)
      return {"bodies slid past each other by a noticeable part of what touches",
              "where there is friction the first step sees them where they are drawn"};
  }
  return {};
}

template <int D, int B>
Solution<B> BodyRun<D, B>::solve_or_take_turns(const Model<B>& model, const LoadStep& step) {
  if constexpr (D == B)
    if (is_paired(model) && scene_.solver.bodies == "dirichlet-neumann") {
      check_turns(scene_, body_, model);
      if (!turns_)
        turns_ = std::make_unique<DirichletNeumann<D>>(scene_, body_, hierarchy_, registry_, progress_, times_);
      return turns_->solve(model, step);
    }
  return accepted_.empty() ? solver_.solve(model) : solver_.solve_after(model, accepted_);
}

namespace {

/// The file of the plugin whose obstacle a message begins with; "" where it is none.
std::string file_of_plugin(const Scene& scene, const Registry& registry, std::string_view message) {
  for (const Scene::Obstacle& obstacle : scene.obstacles)
    if (message.starts_with(obstacle.source.table + ": ")) return registry.entry("obstacle", obstacle.type).file;
  return {};
}

}  // namespace

/// Where there is no solution, perhaps the body was meant to be on the other side.
template <int D, int B>
Solution<B> BodyRun<D, B>::solve(const Model<B>& model, const LoadStep& step) {
  try {
    return solve_or_take_turns(model, step);
  } catch (const Error& error) {
    if (const std::string file = file_of_plugin(scene_, registry_, error.what());
        error.status() == Exit::plugin && !file.empty())
      throw Error(Exit::plugin, fmt::format("{} ({})", error.what(), file));
    if (error.status() != Exit::no_solution) throw;
    const auto reasons = start_warnings(Nodes(hierarchy_.levels.front()), model, true);
    if (reasons.empty()) throw;
    throw Error(error.status(), fmt::format("{}; {}", error.what(), fmt::join(reasons, "; ")));
  }
}

namespace {

/// What rounding leaves of stiffness times displacement, summed over the nodes of a face.
template <int B>
double rounding_of_forces(const BlockMatrix<B>& A, const std::vector<double>& u) {
  constexpr double terms = 64;
  double stiffest = 0;
  for (Index p = 0; p < A.size(); ++p)
    for (int k = 0; k < B; ++k) stiffest = std::max(stiffest, A.diagonal(p)[k * (B + 1)]);
  return terms * std::numeric_limits<double>::epsilon() * stiffest * max_norm(u);
}

void add_once(Warning warning, Warnings& warnings) {
  if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(std::move(warning));
}

}  // namespace

/// Takes what is large of a solution.
template <int D, int B>
void BodyRun<D, B>::take(Solution<B>& solution) {
  results_ = signorini::results<D, B>(nodes(), solver_.moved(model_), solution.discretization, std::move(solution.x),
                                      solution.pressure, slaves_, solver_.shift(), std::move(solution.joints));
}

namespace {

/// What no body ends like, and else how much it is strained.
template <int D, int B>
StrainSizes<D> refuse_nonsense(const Nodes<D>& nodes, const Mesh<D>& coarsest, const Model<B>& model,
                               const ContactState<B>& contact, const std::vector<double>& u) {
  StrainSizes<D> out;
  if constexpr (D == B) {
    refuse_pulling(nodes, model, contact, u);
    out = strains(nodes, model, u);
    refuse_folded(Nodes(coarsest), model, out);
    refuse_turned(nodes, model, u);
  }
  return out;
}

}  // namespace

/// How far conditions that are linear about where bodies were looked at are off where these have come to.
template <int D, int B>
double BodyRun<D, B>::off(const Solution<B>& solution) const {
  const Model<B> model = solver_.moved(model_);
  const ContactState<B> state = contact_state(nodes(), model, solution.discretization, solution.x);
  const std::vector<double> u = to_global(solution.discretization.problem, solution.x);
  try {
    refuse_nonsense(nodes(), hierarchy_.levels.front(), model, state, u);
  } catch (const Error&) {
    return infinity;
  }
  return noticeably_off(deformed_contacts(nodes(), model, state, u), state);
}

/// See noticeably_slid().
template <int D, int B>
double BodyRun<D, B>::slid() const {
  if constexpr (D == B)
    return noticeably_slid<D>(nodes(), model_, results_.contact, results_.masters, results_.u, results_.shift);
  return 0;
}

/// In the first step, if need be; others begin where the last one has come to, see NestedSolver::solve_after().
template <int D, int B>
void BodyRun<D, B>::look_where_it_came(Solution<B>& solution) {
  // Bodies that have slid may touch as truly where they were drawn, and are to touch noticeably as truly where they
  // are: half of this is allowed.
  const double was = std::max(noticeably_off(results_.deformed, results_.contact), slid() > 1 ? 2.0 : 0.0);
  const bool rubs = !solution.discretization.functional.empty();  // the way there would count as slip
  if (D != B || turns_ || follows_ || rubs || !solution.summary.converged() || !(was > 1)) return;
  solution.x = to_local(solution.discretization.problem, results_.u);
  solution.pressure = results_.pressure;
  solution.joints = results_.joints;
  solver_.follow(
      model_, was, [&](const Solution<B>& now) { return off(now); }, solution);
  take(solution);
}

template <int D, int B>
StepReport BodyRun<D, B>::solve(const LoadStep& step, Warnings& warnings) {
  const double t = step.to;
  model_ = model(step);
  model_.follows = follows_;
  place_before(scene_, D, accepted_t_, body_, model_);
  t_ = t;
  check_symmetry(hierarchy_, model_);
  if (step.halvings == 0) solver_.set_spent(false);
  Solution<B> solution = solve(model_, step);
  if (!solution.summary.converged()) solver_.set_spent(true);
  const Stopwatch watch;
  // What cycles leave free is in pieces: a list of nearly all nodes would come on top of it.
  const bool long_list = 2 * solution.discretization.problem.constraints.size() > nodes().size();
  if (long_list) give_freed_memory_back();
  take(solution);
  look_where_it_came(solution);
  model_ = solver_.moved(model_);
  if constexpr (D == B)
    if (solution.summary.converged())
      strains_ = refuse_nonsense(nodes(), hierarchy_.levels.front(), model_, results_.contact, results_.u);
  StepReport report = step_report<D, B>(scene_, nodes(), probes_, results_, t, solution.summary, body_);
  report.undetermined = solution.undetermined;
  if (!solution.undetermined.empty())
    add_once(warning<"undetermined-motion">(model_.origin, fmt::join(solution.undetermined, "; ")), warnings);
  if (solution.pressed_shut > 0) add_once(warning<"pressed-shut">(model_.origin, solution.pressed_shut), warnings);
  if (solution.slides_on) add_once(warning<"slides-on">(model_.origin), warnings);
  const double rounding = rounding_of_forces(solution.discretization.problem.A, results_.u);
  for (Warning& warning :
       balance_warnings<D, B>(scene_, body(), nodes(), solution.discretization.load, report, results_.u, rounding))
    add_once(std::move(warning), warnings);
  // Slender bodies: rounding may do more than products with the matrix show.
  const double lost = report.summary.outcome == Outcome::rounding ? imbalance(report, results_.u) : 0;
  if (lost > inaccurate) {
    report.summary.add_rounding(lost, 0);
    report.bodies.front().summary = report.summary;
  }
  times_.output += watch.elapsed();
  algebraic_error_ = report.summary.algebraic_error;
  rest_ = rest_of_friction(solution.discretization.problem);
  add_estimate(report, solution.discretization, warnings);
  solver_.take_back(model_, std::move(solution.discretization));
  if (long_list) give_freed_memory_back();
  restore_elements(hierarchy_);
  return report;
}

template <int D, int B>
Estimate BodyRun<D, B>::estimate(bool cheap, const std::string& estimator) const {
  EstimateOptions<B> options{{}, algebraic_error_, rest_};
  options.paired_anew = std::ranges::any_of(solver_.shift(), [](const auto& by) { return dot(by, by) > 0; });
  if (nodes().order() > 1 || (B > 1 && !cheap)) options.solve = rough_solve<B>(registry_);
  if constexpr (B > 1) options.pressure = {solver_.pressure_space(), &results_.pressure};
  return create_estimator<D, B>(registry_, estimator)->estimate(nodes(), model_, results_.u, options);
}

template <int D, int B>
void BodyRun<D, B>::add_estimate(StepReport& report, const Discretization<B>& discretization, Warnings& warnings) {
  estimate_of_element_.clear();
  goal_of_element_.clear();
  const std::string& asked = scene_.solver.estimate;
  const std::string estimator = scene_.estimator();
  if (estimator.empty() || !report.summary.converged()) return;
  progress_.phase("estimating the error");
  const Stopwatch watch;
  const bool cheap = asked == "cheap" || (asked == "auto" && B == 3);
  Estimate all = estimate(cheap, estimator);
  if (scene_.refine.adaptive && !std::isfinite(all.estimated)) {
    const std::vector<std::string> reasons = std::exchange(all, estimate(cheap, "recovery")).reasons;
    all.reasons.insert(all.reasons.end(), reasons.begin(), reasons.end());
  }
  Estimate found = of_whole(std::move(all), report.bodies.front().copies);
  found.seconds = watch.elapsed();
  if (found.solve_failed) add_once(warning<"bound-not-sharp">(model_.origin), warnings);
  estimate_of_element_ = std::move(found.of_element);
  report.estimate = std::move(found);
  if (scene_.refine.adaptive && !scene_.refine.is_for_energy()) add_goal(report, discretization);
}

/// Takes the shares in the goal's error in place of those in the energy's.
template <int D, int B>
void BodyRun<D, B>::add_goal(StepReport& report, const Discretization<B>& discretization) {
  progress_.phase("estimating the error of the goal");
  const Stopwatch watch;
  check_goal<D, B>(scene_, body_, model_, solver_.pressure_space() != nullptr);
  const Quantity<B> goal = goal_of(scene_, nodes(), probes_, discretization, results_, report);
  GoalReport found{scene_.refine.goal, goal.value, std::numeric_limits<double>::quiet_NaN()};
  if (const auto z = dual_solution(discretization.problem, goal, rough_solve<B>(registry_))) {
    const std::string named = scene_.estimator(), id = registry_.estimator(named) ? named : "recovery";
    goal_of_element_ = dual_weighted(*create_estimator<D, B>(registry_, id), nodes(), model_, results_.u, *z);
    found.error = goal_error(nodes(), discretization.problem, goal, goal_of_element_);
  }
  report.estimate->goal = std::move(found);
  report.estimate->seconds += watch.elapsed();
}

template class BodyRun<2, 1>;
template class BodyRun<3, 1>;
template class BodyRun<2, 2>;
template class BodyRun<3, 3>;

}  // namespace signorini
