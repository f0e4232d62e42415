#include "driver/driver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/elements/select.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/scene/read_tables.hpp"
#include "core/scene/uses_t.hpp"
#include "driver/components.hpp"
#include "driver/reports/merge.hpp"
#include "driver/scene/fitting_order.hpp"
#include "driver/scene/found_pairs.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/touching_bodies.hpp"
#include "driver/warnings/contact_warnings.hpp"
#include "driver/warnings/unheld_overlaps.hpp"

namespace signorini {
namespace {

/// Of the unknowns: meshes that are hardly finer are not made.
constexpr double least_growth = 1.1;

}  // namespace

const Progress& Driver::waiting() {
  static const Progress progress;
  return progress;
}

Driver::Driver(Scene scene, const Progress& progress)
    : scene_(std::move(scene)), progress_(progress), registry_(all_components()) {
  add_found_pairs(scene_);
  check_components(scene_, registry_);
  report_.scene = scene_.file.string();
  report_.title = scene_.title;
  report_.plugins = load_plugins(scene_, registry_);
}

Driver::~Driver() = default;

namespace {

/// What is kept of the bodies has to be of these.
void refuse_other_bodies(const Scene& kept, const Scene& scene) {
  const auto same = [](const Scene::Body& a, const Scene::Body& b) {
    return a.name == b.name && a.equation == b.equation && a.plane == b.plane && a.order == b.order;
  };
  if (std::ranges::equal(kept.bodies, scene.bodies, same)) return;
  const auto names = [](const Scene& of) {
    std::vector<std::string> all;
    for (const Scene::Body& body : of.bodies) all.push_back(body.name);
    return all;
  };
  throw Error(Exit::usage,
              fmt::format("{}: the bodies are others ({}), or of other kinds, than those that were solved before ({}); "
                          "expected a driver of their own for them",
                          scene.file.string(), fmt::join(names(scene), ", "), fmt::join(names(kept), ", ")));
}

}  // namespace

/// The scene may have changed, but for its bodies.
void Driver::prepare() {
  choose_elements(scene_);
  check_scene(scene_, report_.scene);
  report_.plugins = load_plugins(scene_, registry_);
  if (bodies_.empty()) report_.dimension = scene_.dimension = dimension_of(scene_);  // files are not asked again
  Scene next = with_touching_bodies(scene_);
  if (!bodies_.empty()) {
    keep_chosen_orders(solved_, next);
    refuse_other_bodies(solved_, next);
  }
  solved_ = std::move(next);
  if (bodies_.empty()) build_bodies();
  if (scene_.refine.adaptive) check_adaptive();
}

void Driver::check_adaptive() const {
  const auto fail = [&](const std::string& what) { input_error(scene_.refine.source.of("adaptive"), what); };
  if (bodies() > 1)
    fail(fmt::format("there are {} bodies that nothing lets touch each other, expected one, or some that may touch",
                     bodies()));
  if (scene_.steps.count() > 1) fail(fmt::format("there are {} steps, expected one", scene_.steps.count()));
}

void Driver::require_body(std::size_t body) const {
  if (body < bodies_.size()) return;
  throw Error(Exit::usage, bodies_.empty()
                               ? fmt::format("{}: there are no bodies before a solve has begun", report_.scene)
                               : fmt::format("{}: there is no body {}, expected 0 to {}: bodies that touch each other "
                                             "count as one",
                                             report_.scene, body, bodies_.size() - 1));
}

void Driver::build_bodies() {
  PromisedMemory promised;
  const std::size_t bodies = solved_.bodies.size();
  for (std::size_t body = 0; body < bodies; ++body)
    dispatch(
        solved_,
        [&]<int D, int B>() {
          bodies_.emplace_back(with_fitting_order(solved_, body, mesh_warnings_, [&] {
            return std::make_unique<BodyRun<D, B>>(solved_, body, registry_, progress_, report_.time, mesh_warnings_,
                                                   bodies > 1 ? &promised : nullptr);
          }));
        },
        body);
  for (std::size_t body = 0; body < bodies; ++body)
    std::as_const(*this).visit(body, [&](const auto& run) {
      const auto& meshes = run.hierarchy();
      if (const auto& pieces = meshes.levels.front().pieces; !pieces.empty())
        report_.geometry.push_back({solved_.bodies[body].name, pieces, static_cast<Index>(meshes.straightened.size())});
    });
}

const Report& Driver::solve(const std::function<void()>& done) {
  const Stopwatch watch;
  report_.time = {};
  report_.adaptive.reset();
  progress_.listen();
  if (scene_.steps.at.empty()) throw Error(Exit::usage, fmt::format("{}: no steps to solve", report_.scene));
  prepare();
  do solve_steps(done);
  while (scene_.refine.adaptive && refine(watch.elapsed()));
  report_.time.total = watch.elapsed();
  return report_;
}

void Driver::solve_steps(const std::function<void()>& done) {
  report_.steps.clear();
  report_.failed.clear();
  report_.interrupted = false;
  report_.error.clear();
  report_.warnings = mesh_warnings_;
  const int count = report_.planned_steps = scene_.steps.count();
  try {
    begin();
    double from = 0;
    for (int step = 1; step <= count; from = scene_.steps.at[step++ - 1])
      if (!advance({step, from, scene_.steps.at[step - 1]}, done)) break;
    progress_.stop_if_interrupted();
  } catch (const Error& error) {
    if (report_.steps.empty() || !(report_.has_steps() || report_.interrupted)) throw;
    const bool interrupt = error.status() == Exit::interrupted;
    if (interrupt)
      report_.interrupted = true;
    else
      report_.error = error.what();
    if (!interrupt || !report_.has_steps()) {
      finish();
      throw;
    }
  }
  finish();
}

/// Empty: the next mesh is worth having.
std::string Driver::why_not_refined(const AdaptiveReport& past) const {
  const Scene::Refine& limits = scene_.refine;
  const AdaptiveStep& last = past.steps.back();
  if (std::ssize(past.steps) > limits.max_steps) return fmt::format("refine.max_steps is {}", limits.max_steps);
  if (last.seconds > limits.max_seconds) return fmt::format("refine.max_seconds is {:g}", limits.max_seconds);
  if (static_cast<double>(last.unknowns) * least_growth > limits.max_unknowns)
    return fmt::format("refine.max_unknowns is {}", limits.max_unknowns);
  return {};
}

/// Adds what there is now to the report, and goes on to a finer mesh. False: the present one is the last.
bool Driver::refine(double seconds) {
  if (!report_.adaptive) report_.adaptive.emplace();
  AdaptiveReport& past = *report_.adaptive;
  const StepReport& last = report_.last();
  if (!report_.converged() || report_.interrupted) {
    past.reason = "the last mesh is not solved";
    return false;
  }
  const std::optional<EstimateReport>& error = last.estimate;
  if (!error || !std::isfinite(error->relative_estimated()))
    input_error(scene_.refine.source.of("adaptive"),
                fmt::format("the energy error is not known here: {}",
                            error ? fmt::format("{}", fmt::join(error->reasons, "; ")) : "there is no estimate"));
  past.steps.push_back({visit(0, [](const auto& run) { return static_cast<Index>(run.estimate_of_element().size()); }),
                        last.summary.level_unknowns.back(), last.summary.iterations, last.summary.energy, *error,
                        seconds});
  const double off = error->goal ? error->goal->relative_error() : error->relative_estimated();
  past.reached = off <= scene_.refine.tolerance;
  past.reason = past.reached ? "refine.tolerance is reached" : why_not_refined(past);
  if (past.reason.empty()) {
    const double growth =
        std::min(2.0, scene_.refine.max_unknowns / static_cast<double>(last.summary.level_unknowns.back()));
    try {
      Warnings warnings;
      AnyRun next = std::visit([&](const auto& run) -> AnyRun { return run->refined(growth, warnings); }, bodies_[0]);
      const std::size_t numbers = std::visit([](const auto& run) { return run->numbers(); }, next);
      if (numbers > static_cast<std::size_t>(scene_.refine.max_unknowns))
        throw TooLarge(scene_.refine.source.of("max_unknowns"),
                       fmt::format("{} numbers, refine.max_unknowns is {}", numbers, scene_.refine.max_unknowns));
      bodies_[0] = std::move(next);
      for (Warning& warning : warnings)
        if (std::ranges::find(mesh_warnings_, warning) == mesh_warnings_.end())
          mesh_warnings_.push_back(std::move(warning));
      return true;
    } catch (const TooLarge& why) {
      past.reason = fmt::format("the next mesh would be too large: {}", why.complaint());
    }
  }
  if (!past.reached)
    report_.warnings.push_back(warning<"accuracy-not-reached">(
        scene_.refine.source.of("tolerance"), error->goal ? error->goal->name : "energy",
        std::isfinite(error->upper) && !error->goal ? "at most" : "about", off, scene_.refine.tolerance, past.reason));
  return false;
}

void Driver::begin() {
  for (std::size_t body = 0; body < bodies(); ++body) visit(body, [](auto& run) { run.find_probes(); });
  const double t = scene_.steps.at.front();
  at_step(scene_, t, [&] {
    for (std::size_t body = 0; body < bodies(); ++body)
      visit(body, [&](auto& run) {
        run.begin(t);
        run.add_warnings(t, report_.warnings);
      });
  });
}

/// Where the step fails, in two parts. False where that fails, too, and the steps end.
bool Driver::advance(const LoadStep& by, const std::function<void()>& done) {
  const bool whole = by.halvings == 0;
  progress_.step(by, report_.planned_steps);
  Warnings warnings = report_.warnings;  // those of what fails are of no use
  StepReport report = at_step(scene_, by.to, [&] { return solve_step(by, warnings); });
  if (progress_.is_ended()) return keep_iterate(std::move(report), std::move(warnings));
  const bool stuck = is_stuck(report);
  FrictionDoubt doubt;
  for (std::size_t body = 0; body < bodies() && !stuck && !doubt.reason; ++body) doubt = doubt_of_friction(by, body);
  const bool parts_differ = (stuck || doubt.reason) && may_be_cut(by, report);
  const std::string* veto = parts_differ ? veto_against_cutting() : nullptr;
  if (parts_differ && !veto) {
    note_failure(by, stuck ? "no solution was found" : doubt.reason, report.summary.iterations,
                 stuck ? report.summary.reason : doubt.why);
    const double middle = by.from + (by.to - by.from) * doubt.cut_at;
    return advance({by.number, by.from, middle, by.halvings + 1}, done) &&
           advance({by.number, middle, by.to, by.halvings + 1}, done);
  }
  if (!stuck) accept();
  if (stuck && !whole)
    report.summary.reason += fmt::format("; this is the part from t = {} to {} of a step that was cut in two {} times",
                                         by.from, by.to, by.halvings);
  if (stuck && veto) report.summary.reason += fmt::format("; {} does not admit that the step is cut in two", *veto);
  if (doubt.reason) warnings.push_back(warning<"friction-turned">(by.number, by.to, doubt.reason, doubt.why));
  report_.warnings = std::move(warnings);
  add_step(std::move(report));
  if (done) done();
  return !stuck;
}

/// Of steps those that were finished are enough. What a single one has come to is worth having: until the work was
/// ended that was all of it.
bool Driver::keep_iterate(StepReport report, Warnings warnings) {
  if (report_.has_steps()) progress_.stop_if_interrupted();
  report_.interrupted = true;
  warnings.push_back(warning<"interrupted">());
  report_.warnings = std::move(warnings);
  add_step(std::move(report));
  return false;
}

/// Whether a body was not solved that a next step would have to start from.
bool Driver::is_stuck(const StepReport& report) const {
  for (std::size_t body = 0; body < bodies(); ++body)
    if (!report.bodies[body].summary.converged() && visit(body, [](const auto& run) { return run.remembers(); }))
      return true;
  return false;
}

/// A step is cut for all bodies, or for none. Null: nothing is against it.
const std::string* Driver::veto_against_cutting() const {
  for (std::size_t body = 0; body < bodies(); ++body)
    if (const auto* of = visit(body, [](const auto& run) { return run.veto_against_cutting(); })) return of;
  return nullptr;
}

FrictionDoubt Driver::doubt_of_friction(const LoadStep& by, std::size_t body) const {
  const double end = scene_.steps.at[by.number - 1];
  return visit(body, [&](const auto& run) { return run.doubt_of_friction(by, end, by.to < scene_.steps.at.back()); });
}

/// A part differs from the whole where something of the body in question depends on t, or on the step.
bool Driver::may_be_cut(const LoadStep& by, const StepReport& report) const {
  const double middle = by.from + (by.to - by.from) / 2;
  if (by.halvings >= scene_.steps.halvings || !(by.from < middle && middle < by.to)) return false;
  for (std::size_t body = 0; body < bodies(); ++body)
    if ((!report.bodies[body].summary.converged() || doubt_of_friction(by, body).reason) &&
        (uses_t(solved_, solved_.bodies[body]) || visit(body, [](const auto& run) { return run.depends_on_step(); })))
      return true;
  return false;
}

void Driver::note_failure(const LoadStep& by, const char* what, int iterations, const std::string& reason) {
  report_.failed.push_back({by.number, by.from, by.to, iterations, reason});
  report_.warnings.push_back(warning<"step-cut">(by.number, by.from, by.to, what, reason));
}

void Driver::forget_matrices() {
  for (std::size_t body = 0; body < bodies(); ++body) visit(body, [](auto& run) { run.forget_matrices(); });
}

void Driver::accept() {
  for (std::size_t body = 0; body < bodies(); ++body) visit(body, [](auto& run) { run.accept(); });
}

/// Friction has dissipated what it did in all steps.
void Driver::add_step(StepReport report) {
  if (!report_.steps.empty())
    for (std::size_t k = 0; k < report.contact.size(); ++k)
      report.contact[k].dissipated += report_.steps.back().contact[k].dissipated;
  report_.steps.push_back(std::move(report));
}

StepReport Driver::solve_step(const LoadStep& by, Warnings& warnings) {
  std::vector<StepReport> reports;
  for (std::size_t body = 0; body < bodies(); ++body) {
    if (bodies() > 1) progress_.phase(fmt::format("body '{}'", solved_.bodies[body].name));
    reports.push_back(visit(body, [&](auto& run) { return run.solve(by, warnings); }));
  }
  StepReport report = merged(scene_, std::move(reports));
  report.step = by.number;
  report.from = by.from;
  report.halvings = by.halvings;
  return report;
}

void Driver::finish() {
  Warnings& warnings = report_.warnings;
  for (auto& warning : contact_warnings(scene_, report_)) warnings.push_back(std::move(warning));
  for (std::size_t body = 0; body < bodies(); ++body)
    std::as_const(*this).visit(body, [&](const auto& run) {
      run.add_result_warnings(report_, warnings);
      if (run.by_matrix()) report_.hierarchy = "matrix";
    });
  if (scene_.bodies.size() < 2 || !report_.converged()) return;
  add_unheld_overlaps<2>();
  add_unheld_overlaps<3>();
}

template <int D>
void Driver::add_unheld_overlaps() {
  MovedBoundaries<D> all;
  for (std::size_t k = 0; k < bodies(); ++k) {
    const auto* run = std::get_if<Run<D, D>>(&bodies_[k]);
    if (!run) continue;
    const std::vector<double> u = (*run)->solution();
    const auto add = [&](const Scene::Body& body, const std::string& name) {
      all.add((*run)->mesh(), name, select_faces((*run)->mesh(), on_mesh_of(body, name, {"boundary", {}, ""}), 1), u);
    };
    const Scene::Body& body = solved_.bodies[k];
    if (body.parts.empty()) add(body, body.name);
    for (const Scene::Body& part : body.parts) add(body, part.name);
  }
  if (all.body.size() < 2) return;
  for (Warning& warning : unheld_overlaps(solved_, all)) report_.warnings.push_back(std::move(warning));
}

void Driver::start_from(std::size_t body, std::vector<double> u) {
  prepare();
  visit(body, [&](auto& run) { run.start_from(std::move(u)); });
}

std::vector<double> Driver::solution(std::size_t body) const {
  return visit(body, [](const auto& run) { return run.solution(); });
}

std::vector<double> Driver::points(std::size_t body) const {
  return visit(body, [](const auto& run) {
    std::vector<double> points;
    for (const auto& point : run.mesh().points) points.insert(points.end(), point.begin(), point.end());
    return points;
  });
}

}  // namespace signorini
