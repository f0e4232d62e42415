#include "apps/bench/friction/partial_slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "apps/bench/friction/partial_slip_theory.hpp"
#include "apps/bench/problems.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {
using std::numbers::pi;

constexpr double friction = 0.05;  // of the scenes

RoundContact round_contact(const Scene& scene) {
  const Scene::Body& body = scene.bodies[0];
  return {scene.dimension, scene.dimension == 2 ? 1.0 : 4.0, *body.young.constant(), *body.poisson.constant(),
          friction};
}

Scene read(const PartialSlipScene& scene) {
  std::vector<std::string> overrides{fmt::format("refine.uniform={}", scene.refinements)};
  if (!scene.turns) {
    overrides.push_back("steps.count=2");
    overrides.push_back(fmt::format("fix.0.value.0=\"{} * (t > 0.6)\"", scene.dimension == 2 ? 3e-5 : 9e-5));
    overrides.push_back(fmt::format("obstacle.0.friction=\"t < 0.6 ? 0 : {}\"", friction));
  }
  overrides.insert(overrides.end(), scene.overrides.begin(), scene.overrides.end());
  return linear_scene(fmt::format("partial_slip_{}d.toml", scene.dimension), std::move(overrides));
}

double radius(double area, int dimension) { return dimension == 2 ? area / 2 : std::sqrt(area / pi); }

/// Differences of tractions on the body from the theory, which has them along the force.
class Differences {
 public:
  /// @param inside away from where its slope is infinite
  template <int D>
  void add(const std::array<double, D>& traction, double in_theory, double area, bool inside) {
    const double along = std::abs(traction[0] + in_theory);
    squares_ += area * along * along;
    if constexpr (D == 3) across_ += area * traction[1] * traction[1];
    area_ += area;
    largest_ = std::max(largest_, along);
    if (inside) largest_inside_ = std::max(largest_inside_, along);
  }
  double mean() const { return area_ > 0 ? std::sqrt(squares_ / area_) : 0; }
  double across() const { return area_ > 0 ? std::sqrt(across_ / area_) : 0; }
  double largest() const { return largest_; }
  double largest_inside() const { return largest_inside_; }

 private:
  double squares_ = 0, across_ = 0, area_ = 0, largest_ = 0, largest_inside_ = 0;
};

/// Adds to a step what its nodes tell.
template <int D>
void measure(const BodyRun<D, D>& run, const PartialSlipTheory& theory, PartialSlipStep& step) {
  const auto& nodes = run.results().contact.nodes;
  double touches = 0, sticks = 0;
  for (const ContactNode<D>& node : nodes) {
    if (!node.contact) continue;
    ++step.nodes;
    touches += node.area;
    if (node.sticks) sticks += node.area;
  }
  step.contact = radius(touches, D), step.contact_in_theory = theory.contact_radius();
  step.stick = radius(sticks, D), step.stick_in_theory = theory.stick_radius();
  const double spacing = D == 2 ? touches / step.nodes : std::sqrt(touches / step.nodes), near = 2 * spacing;
  Differences recovered, nodal;
  for (const ContactNode<D>& node : nodes) {
    if (!node.contact) continue;
    const Point<D>& x = run.nodes().at(node.vertex);
    const double r = D == 2 ? std::abs(x[0]) : std::hypot(x[0], x[1]), expected = theory.traction(r);
    const bool inside = std::abs(r - step.stick_in_theory) > near && r < step.contact_in_theory - near;
    recovered.add<D>(node.traction, expected, node.area, inside);
    std::array<double, D> mean = node.tangential;
    for (double& f : mean) f /= node.area;
    nodal.add<D>(mean, expected, node.area, inside);
  }
  if (const double peak = theory.peak_traction(); peak > 0) {
    step.mean_error = recovered.mean() / peak, step.largest_error = recovered.largest() / peak;
    step.largest_inside = recovered.largest_inside() / peak, step.across = recovered.across() / peak;
    step.nodal_mean_error = nodal.mean() / peak, step.nodal_largest_error = nodal.largest() / peak;
  }
}

PartialSlipStep forces(const StepReport& report) {
  if (!report.summary.converged()) throw Error(Exit::not_converged, report.summary.reason);
  const ContactReport& contact = report.contact[0];
  PartialSlipStep step;
  step.normal = std::abs(contact.normal_force.back());
  step.tangential = -contact.tangential_force[0];
  step.dissipated = contact.dissipated;
  step.iterations = report.summary.iterations;
  return step;
}

/// What a closed loop dissipates: from the largest tangential force to the end.
/// @param held displacement of what is held, per step
void add_loop(const std::vector<double>& held, const PartialSlipTheory& theory, PartialSlip& out) {
  const auto& steps = out.steps;
  std::size_t turn = 0;
  while (turn + 1 < steps.size() && steps[turn + 1].tangential > steps[turn].tangential - 1e-6 * out.limit) ++turn;
  for (std::size_t k = turn; k + 1 < steps.size(); ++k)
    out.enclosed += 0.5 * (steps[k].tangential + steps[k + 1].tangential) * (held[k + 1] - held[k]);
  out.dissipated = steps.back().dissipated - steps[turn].dissipated;
  out.loop = theory.loop(steps[turn].tangential);
}

double percent(double computed, double expected) { return 100 * (computed / expected - 1); }

/// In space quadratic elements, whose contact pressures scatter less on irregular faces.
std::vector<std::string> elements(int dimension) {
  return dimension == 2 ? std::vector<std::string>{} : std::vector<std::string>{"body.0.order=2"};
}

void print_loading(int dimension, int from, int to) {
  fmt::print(
      "## {}D, loading\n\n| unknowns | nodes in contact | contact radius | stick radius | traction, mean (nodal) | "
      "largest inside | largest (nodal) | across | cycles | seconds |\n| --- | --- | --- | --- | --- | --- | --- | --- "
      "| "
      "--- | --- |\n",
      dimension);
  for (int k = from; k <= to; ++k) {
    const PartialSlip slip = solve_partial_slip({dimension, k, false, elements(dimension)});
    const PartialSlipStep& s = slip.steps.back();
    fmt::print(
        "| {} | {} | {:+.1f} % | {:+.1f} % | {:.1f} % ({:.1f}) | {:.1f} % | {:.1f} % ({:.0f}) | {:.1f} % | {}, {} | "
        "{:.1f} |\n",
        slip.unknowns, s.nodes, percent(s.contact, s.contact_in_theory), percent(s.stick, s.stick_in_theory),
        100 * s.mean_error, 100 * s.nodal_mean_error, 100 * s.largest_inside, 100 * s.largest_error,
        100 * s.nodal_largest_error, 100 * s.across, slip.steps[0].iterations, s.iterations, slip.seconds);
    std::fflush(stdout);
  }
}

void print_loop(int dimension, int refinements) {
  const PartialSlip slip = solve_partial_slip({dimension, refinements, true, elements(dimension)});
  fmt::print(
      "\n## {}D, there and back, {} unknowns\n\n| force over its limit | radius that sticks over the contact's | in "
      "theory | traction, mean | cycles |\n| --- | --- | --- | --- | --- |\n",
      dimension, slip.unknowns);
  for (std::size_t k = 1; k < slip.steps.size(); ++k) {
    const PartialSlipStep& s = slip.steps[k];
    fmt::print("| {:+.3f} | {:.3f} | {:.3f} | {:.1f} % | {} |\n", s.tangential / slip.limit,
               s.stick / s.contact_in_theory, s.stick_in_theory / s.contact_in_theory, 100 * s.mean_error,
               s.iterations);
  }
  fmt::print("\nDissipated in the loop: {:.4g}, in theory {:.4g}, {:+.1f} %. {:.1f} seconds.\n\n", slip.dissipated,
             slip.loop, percent(slip.dissipated, slip.loop), slip.seconds);
  std::fflush(stdout);
}

void print_coupling(int refinements) {
  fmt::print(
      "## 2D, Poisson's ratio\n\n| Poisson's ratio | beta | stick radius | traction, mean | dissipated |\n| --- | --- "
      "| "
      "--- | --- | --- |\n");
  for (const double poisson : {0.2, 0.3, 0.4, 0.45, 0.48}) {
    const PartialSlip slip =
        solve_partial_slip({2, refinements, true, {fmt::format("body.0.poisson={}", poisson), "body.0.order=1"}});
    const PartialSlipStep& s = slip.steps.back();
    fmt::print("| {} | {:.3f} | {:+.1f} % | {:.1f} % | {:+.1f} % |\n", poisson, (1 - 2 * poisson) / (2 - 2 * poisson),
               percent(s.stick, s.stick_in_theory), 100 * s.mean_error, percent(slip.dissipated, slip.loop));
    std::fflush(stdout);
  }
}

}  // namespace

PartialSlip solve_partial_slip(const PartialSlipScene& scene) {
  Driver driver(read(scene));
  PartialSlip out;
  std::optional<PartialSlipTheory> theory;
  std::vector<double> held;
  const Stopwatch watch;
  driver.solve([&] {
    const StepReport& report = driver.report().last();
    PartialSlipStep step = forces(report);
    if (!theory)
      theory.emplace(round_contact(driver.scene()), step.normal);
    else
      theory->move_to(step.tangential);
    driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>& run) {
      if constexpr (D == B) measure<D>(run, *theory, step);
    });
    out.steps.push_back(step);
    out.unknowns = static_cast<double>(report.summary.level_unknowns.back());
    held.push_back(report.probes[0].value[0]);
  });
  out.seconds = watch.elapsed();
  out.limit = friction * out.steps[0].normal;
  add_loop(held, *theory, out);
  return out;
}

void print_partial_slip(bool quick) {
  const int less = quick ? 2 : 0;
  print_loading(2, 1, 5 - less);
  print_loop(2, 4 - less);
  print_coupling(4 - less);
  fmt::print("\n");
  print_loading(3, 0, 2 - less);
  print_loop(3, 1 - less / 2);
}

}  // namespace signorini::bench
