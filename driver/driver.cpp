#include "driver/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "amg/registration.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "driver/components.hpp"
#include "driver/contact_warnings.hpp"
#include "driver/merge.hpp"
#include "driver/problem.hpp"

namespace signorini {

const Progress& Driver::waiting() {
  static const Progress progress;
  return progress;
}

Driver::Driver(Scene scene, const Progress& progress)
    : scene_(std::move(scene)), progress_(progress), registry_(solver_components()) {
  check_components(scene_, registry_);
  report_.scene = scene_.file.string();
  report_.title = scene_.title;
  report_.plugins = load_plugins(scene_, registry_);
}

Driver::~Driver() = default;

void Driver::build_bodies() {
  report_.dimension = scene_.dimension = dimension_of(scene_);  // files are not asked again
  PromisedMemory promised;
  const std::size_t bodies = scene_.bodies.size();
  for (std::size_t body = 0; body < bodies; ++body)
    dispatch(
        scene_,
        [&]<int D, int B>() {
          bodies_.emplace_back(std::make_unique<BodyRun<D, B>>(scene_, body, registry_, progress_, report_.time,
                                                               mesh_warnings_, bodies > 1 ? &promised : nullptr));
        },
        body);
}

const Report& Driver::solve(const std::function<void()>& done) {
  const Stopwatch watch;
  report_.time = {};
  report_.steps.clear();
  report_.interrupted = false;
  if (bodies_.empty()) build_bodies();
  report_.warnings = mesh_warnings_;
  const int count = scene_.steps.count;
  try {
    for (int step = 1; step <= count; ++step) {
      if (count > 1) progress_.phase(fmt::format("step {} of {}", step, count));
      const double t = static_cast<double>(step) / count;
      at_step(scene_, t, [&] {
        if (step == 1)
          for (std::size_t body = 0; body < bodies(); ++body)
            visit(body, [&](auto& run) {
              run.begin();
              run.add_warnings(t, report_.warnings);
            });
        add_step(solve_step(t));
      });
      if (done) done();
    }
    progress_.stop_if_interrupted();
  } catch (const Error& error) {
    if (error.status() != Exit::interrupted || count == 1 || report_.steps.empty()) throw;
    report_.interrupted = true;
  }
  finish();
  report_.time.total = watch.elapsed();
  return report_;
}

/// Friction has dissipated what it did in all steps.
void Driver::add_step(StepReport report) {
  if (!report_.steps.empty())
    for (std::size_t k = 0; k < report.contact.size(); ++k)
      report.contact[k].dissipated += report_.steps.back().contact[k].dissipated;
  report_.steps.push_back(std::move(report));
}

StepReport Driver::solve_step(double t) {
  std::vector<StepReport> reports;
  for (std::size_t body = 0; body < bodies(); ++body) {
    if (bodies() > 1) progress_.phase(fmt::format("body '{}'", scene_.bodies[body].name));
    reports.push_back(visit(body, [&](auto& run) { return run.solve(t, report_.warnings); }));
  }
  return merged(scene_, std::move(reports));
}

void Driver::finish() {
  std::vector<std::string>& warnings = report_.warnings;
  for (auto& warning : contact_warnings(scene_, report_)) warnings.push_back(std::move(warning));
  for (std::size_t body = 0; body < bodies(); ++body)
    std::as_const(*this).visit(body, [&](const auto& run) {
      run.add_result_warnings(warnings);
      if (run.by_matrix()) report_.hierarchy = "matrix";
    });
}

void Driver::start_from(std::size_t body, std::vector<double> u) {
  if (bodies_.empty()) build_bodies();
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
