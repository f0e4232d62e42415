#include "apps/signorini/show_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini {
namespace {

using Vector = std::vector<double>;

double length(const Vector& v) { return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0)); }

/// Of the obstacles' numbers in the report's lists.
std::string named(const StepReport& step, std::size_t k, const char* what) {
  const std::string name = step.contact.size() > 1 ? fmt::format("obstacle {}", step.contact[k].obstacle) : "";
  return name.empty() || *what == 0 ? name + what : name + ": " + what;
}

bool has_friction(const Report& report, std::size_t k) {
  return std::ranges::any_of(report.steps, [&](const StepReport& step) {
    return step.contact[k].slip_nodes + step.contact[k].stick_nodes > 0 || step.contact[k].dissipated > 0;
  });
}

bool has_friction(const Report& report) {
  for (std::size_t k = 0; k < report.last().contact.size(); ++k)
    if (has_friction(report, k)) return true;
  return false;
}

/// The direction in which a force is largest in all steps; empty where it is zero.
Vector main_axis(const Report& report, std::size_t k, Vector ContactReport::*force) {
  const auto& largest = *std::ranges::max_element(
      report.steps, {}, [&](const StepReport& step) { return length(step.contact[k].*force); });
  Vector axis = largest.contact[k].*force;
  const double size = length(axis);
  if (!(size > 0)) return {};
  for (double& a : axis) a /= size;
  return axis;
}

double along(const Vector& axis, const Vector& v) {
  return std::inner_product(axis.begin(), axis.end(), v.begin(), 0.0);
}

/// Whether a force keeps to a line in all steps, to and fro.
bool keeps_to(const Vector& axis, const Report& report, std::size_t k, Vector ContactReport::*force) {
  constexpr double across = 0.01;  // of the largest
  double largest = 0, off = 0;
  for (const StepReport& step : report.steps) {
    Vector rest = step.contact[k].*force;
    const double part = along(axis, rest);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= part * axis[i];
    largest = std::max(largest, std::abs(part));
    off = std::max(off, length(rest));
  }
  return off <= across * largest;
}

/// With its sign where the force keeps to a line, so that one that turns round is seen to do so; else its size.
Line over_t(const Report& report, std::size_t k, Vector ContactReport::*force, std::string name) {
  const Vector axis = main_axis(report, k, force);
  const bool line_only = axis.empty() || keeps_to(axis, report, k, force);
  Line line{{{0, 0}}, line_only ? std::move(name) : name + ", size"};
  for (const StepReport& step : report.steps) {
    const Vector& f = step.contact[k].*force;
    line.points.push_back({step.t, line_only ? along(axis, f) : length(f)});
  }
  return line;
}

Panel forces_over_t(const Report& report) {
  Panel panel;
  panel.title = "forces of the obstacles";
  panel.label = "force";
  panel.across = "t";
  panel.view = View::lines;
  for (std::size_t k = 0; k < report.last().contact.size(); ++k) {
    panel.lines.push_back(over_t(report, k, &ContactReport::normal_force, named(report.last(), k, "normal")));
    if (has_friction(report, k))
      panel.lines.push_back(over_t(report, k, &ContactReport::tangential_force, named(report.last(), k, "tangential")));
  }
  return panel;
}

/// How far what the force acts on has moved along the obstacle, see steps_panels().
Vector displacement(const StepReport& step, std::size_t k) {
  const ContactReport& contact = step.contact[k];
  const auto probe = std::ranges::find(step.probes, contact.body, &ProbeReport::body);
  Vector u = probe == step.probes.end() ? contact.displacement : probe->value;
  for (std::size_t i = 0; i < contact.motion.size(); ++i) u[i] -= contact.motion[i];
  return u;
}

/// What moves the body against the force of the obstacle, along the direction in which that is largest.
Line over_displacement(const Report& report, std::size_t k, Vector ContactReport::*force, std::string name) {
  const Vector axis = main_axis(report, k, force);
  Line line{{}, std::move(name)};
  if (axis.empty()) return line;
  line.points.push_back({0, 0});
  for (const StepReport& step : report.steps)
    line.points.push_back({-along(axis, displacement(step, k)), along(axis, step.contact[k].*force)});
  return line;
}

Panel force_over_displacement(const Report& report) {
  const bool friction = has_friction(report);
  const auto force = friction ? &ContactReport::tangential_force : &ContactReport::normal_force;
  Panel panel;
  panel.title = friction ? "tangential force over displacement" : "normal force over displacement";
  panel.label = "force";
  panel.across = "displacement against it";
  panel.view = View::lines;
  for (std::size_t k = 0; k < report.last().contact.size(); ++k) {
    Line line =
        over_displacement(report, k, force, report.last().contact.size() > 1 ? named(report.last(), k, "") : "");
    if (!line.points.empty()) panel.lines.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

std::vector<Panel> steps_panels(const Report& report) {
  std::vector<Panel> panels{forces_over_t(report), force_over_displacement(report)};
  std::erase_if(panels, [](const Panel& panel) { return panel.lines.empty(); });
  return panels;
}

}  // namespace signorini
