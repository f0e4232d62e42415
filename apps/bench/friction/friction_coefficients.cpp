#include "apps/bench/friction/friction_coefficients.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "apps/bench/friction/friction_law.hpp"
#include "apps/bench/friction/friction_scenes.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

// Of the normals of the wedge's sides, as its scene has them; tan 20 is their ratio.
constexpr double across = 0.93969262, along = 0.34202014;

/// A scene and what is known of it besides.
template <int D>
struct Judged {
  FrictionScene scene;
  double young, poisson;
  std::vector<RoughPlane<D>> planes;  // without coefficients
  std::vector<std::string> fixed;
  std::vector<std::vector<Traction<D>>> loads;  // per step; empty: none
};

/// What became of all steps.
struct Outcome {
  std::vector<int> cycles;  // of each step
  bool solved = true;
  std::string reason;                  // of the step that was not solved
  LawViolation law;                    // of the last step, its worst of all
  double pressing = 0;                 // the length of the first obstacle's normal force, after the last step
  std::vector<std::vector<double>> u;  // after each step
};

template <int D>
Outcome run(const Judged<D>& problem, double friction, const Overrides& more) {
  Outcome out;
  try {
    Driver driver(problem.scene.with(friction, more));
    std::vector<RoughPlane<D>> planes = problem.planes;
    for (RoughPlane<D>& plane : planes) plane.friction = friction;
    std::vector<double> last;
    double worst = 0;
    driver.solve([&] {
      const StepReport& step = driver.report().last();
      const std::vector<double> u = driver.solution();
      if (last.empty()) last.assign(u.size(), 0.0);
      out.cycles.push_back(step.summary.iterations);
      if (!step.summary.converged()) {
        out.solved = false;
        out.reason = step.summary.reason;
        return;
      }
      driver.visit(0, [&](const auto& body) {
        if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<D, D>>) {
          const std::size_t k = out.u.size();
          out.law = law_violation<D>(body.mesh(), problem.young, problem.poisson, planes,
                                     k < problem.loads.size() ? problem.loads[k] : std::vector<Traction<D>>{},
                                     problem.fixed, u, last);
        }
      });
      worst = std::max(worst, out.law.worst());
      double square = 0;
      for (const double f : step.contact[0].normal_force) square += f * f;
      out.pressing = std::sqrt(square);
      out.u.push_back(last = u);
    });
    out.law.force = worst;
    if (!driver.report().failed.empty()) {
      out.solved = false;
      out.reason = driver.report().failed.front().reason;
    }
  } catch (const Error& error) {
    out.solved = false;
    out.reason = error.what();
  }
  return out;
}

/// The largest difference of displacements over the largest displacement, in the worst step.
std::string apart(const Outcome& a, const Outcome& b) {
  if (!b.solved) return "no answer";
  double worst = 0;
  for (std::size_t k = 0; k < a.u.size(); ++k) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.u[k].size(); ++i) {
      largest = std::max(largest, std::abs(a.u[k][i]));
      difference = std::max(difference, std::abs(a.u[k][i] - b.u[k][i]));
    }
    worst = std::max(worst, difference / largest);
  }
  return fmt::format("{:.0e}", worst);
}

std::string list(const std::vector<int>& numbers) { return fmt::format("{}", fmt::join(numbers, ", ")); }

/// @param law what else is known of the force that presses on an obstacle; empty: nothing
template <int D>
void table(const Judged<D>& problem, const std::vector<double>& coefficients,
           const std::function<std::string(double friction, double pressing)>& law = {}) {
  fmt::print("\n## {}\n\n| friction | cycles | open | slip | stick | law | from newton |{}\n", problem.scene.name,
             law ? " normal force |" : "");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |{}\n", law ? " --- |" : "");
  std::vector<std::string> reasons;
  for (const double friction : coefficients) {
    const Outcome own = run(problem, friction, {});
    if (own.solved) {
      const Outcome newton = run(problem, friction, {"solver.method=newton"});
      fmt::print("| {} | {} | {} | {} | {} | {:.0e} | {} |", friction, list(own.cycles), own.law.open, own.law.slipping,
                 own.law.sticking, own.law.worst(), apart(own, newton));
    } else {
      const Outcome newton = run(problem, friction, {"solver.method=newton"});
      fmt::print("| {} | none ({}) | | | | | {} |", friction, list(own.cycles), newton.solved ? "solved" : "no answer");
      reasons.push_back(fmt::format("{}: {}", friction, own.reason));
    }
    if (law) fmt::print(" {} |", own.solved ? law(friction, own.pressing) : "");
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (const std::string& reason : reasons) fmt::print("\n{}\n", reason);
}

Judged<2> judged(const FrictionScene& block) { return {block, 1, 0.3, {{"bottom", {0, 0}, {0, 1}, 0}}, {"top"}, {}}; }

Judged<3> judged(const FrictionScene& block, const std::string& part, const std::string& top, double z) {
  return {block, 1, 0.3, {{part, {0, 0, z}, {0, 0, 1}, 0}}, {top}, {}};
}

Judged<2> judged_wedge(int refinements) {
  const double length = std::hypot(across, along), c = across / length, s = along / length;
  Judged<2> out{wedge(refinements), 1, 0.3, {{"edge1", {0.3, 0}, {-c, s}, 0}, {"edge3", {-0.3, 0}, {c, s}, 0}}, {}, {}};
  for (const double part : {1.0, 0.82, 0.55, 0.28, 0.1}) out.loads.push_back({{"edge2", {0, -0.01 * part}}});
  return out;
}

/// The force on a side after unloading over that by which all of it slips outwards.
std::string outwards(double friction, double pressing) {
  const double less = along - friction * across;
  const double load = 0.001 * 2 * (0.3 + along / across);
  return less > 0 ? fmt::format("{:.5f}, all slipping out {:.5f}", pressing, load / (2 * less))
                  : fmt::format("{:.5f}, locks", pressing);
}

}  // namespace

void print_friction_coefficients(bool quick) {
  const int less = quick ? 1 : 0;
  const std::vector<double> coefficients{0, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5};
  fmt::print("# Coefficients of friction from 0 to 5\n");
  table(judged(block_2d("Block in the plane, top moved by (0.03, -0.03)", "[0.03, -0.03]", 5 - less)), coefficients);
  table(judged(block_2d("Block in the plane, top moved by (0.1, -0.01)", "[0.1, -0.01]", 5 - less)), coefficients);
  table(judged(block_3d("Block in space, top moved by (0.03, 0.015, -0.03)", "[0.03, 0.015, -0.03]", 2 - less),
               "bottom", "top", 0),
        coefficients);
  table(judged(block_3d("Block in space, top moved by (0.1, 0.05, -0.01)", "[0.1, 0.05, -0.01]", 2 - less), "bottom",
               "top", 0),
        coefficients);
  table(judged_wedge(3 - less), {0, 0.1, 0.2, 0.3, 0.35, 0.36, 0.37, 0.4, 0.5, 1, 2, 5}, outwards);
  table(judged(ball(1 - less), "curved", "flat", -1), coefficients);
}

}  // namespace signorini::bench
