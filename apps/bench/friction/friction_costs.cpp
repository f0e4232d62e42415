#include "apps/bench/friction/friction_costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "apps/bench/friction/friction_scenes.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

/// All steps of one scene.
struct Steps {
  std::vector<int> cycles;
  std::vector<double> seconds;  ///< of processor time, per step: bounds, set-up, cycles and results
  double unknowns = 0;
  bool solved = true;

  int most_cycles() const { return *std::ranges::max_element(cycles); }
  /// Without the first step, which assembles the matrix, where there are others.
  double time() const {
    double sum = 0;
    for (std::size_t k = seconds.size() > 1 ? 1 : 0; k < seconds.size(); ++k) sum += seconds[k];
    return sum;
  }
  double whole() const {
    double sum = 0;
    for (const double s : seconds) sum += s;
    return sum;
  }
};

Steps solve(const Scene& scene) {
  Steps out;
  Driver driver(scene);
  std::optional<ProcessorTime> watch(std::in_place);
  driver.solve([&] {
    const Summary& summary = driver.report().last().summary;
    out.seconds.push_back(watch->elapsed());
    out.cycles.push_back(summary.iterations);
    out.unknowns = summary.level_unknowns.back();
    out.solved = out.solved && summary.converged();
    watch.emplace();
  });
  out.solved = out.solved && driver.report().failed.empty();
  return out;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// The median of ratios of `time`, from runs in turns; results are those of the last pair.
struct Pairs {
  Steps first, second;
  double ratio;

  Pairs(int count, const Scene& a, const Scene& b, const std::function<double(const Steps&)>& time) {
    std::vector<double> ratios;
    for (int k = 0; k < count; ++k) {
      first = solve(a);
      second = solve(b);
      ratios.push_back(time(first) / time(second));
    }
    ratio = median(ratios);
  }
};

double step_time(const Steps& steps) { return steps.time(); }
double whole_time(const Steps& steps) { return steps.whole(); }

int pairs_for(double unknowns) { return unknowns < 1e5 ? 9 : unknowns < 5e5 ? 5 : 3; }

std::string list(const std::vector<int>& numbers) { return fmt::format("{}", fmt::join(numbers, ", ")); }

void row(const std::string& text) { fmt::print("{}\n", text), std::fflush(stdout); }

/// The way of the top in `count` steps: pressed and pushed at the same time.
FrictionScene plane_steps(int refinements, int count) {
  FrictionScene scene = block_2d("block 2D", "[\"0.01*t\", \"-0.03*t\"]", refinements);
  scene.overrides.push_back(fmt::format("steps.count={}", count));
  return scene;
}

FrictionScene space_steps(int refinements, int count) {
  FrictionScene scene = block_3d("block 3D", "[\"0.01*t\", \"0.005*t\", \"-0.03*t\"]", refinements);
  scene.overrides.push_back(fmt::format("steps.count={}", count));
  return scene;
}

void with_and_without(const char* levels, const FrictionScene& scene, double unknowns, const Overrides& more,
                      double friction = 0.3) {
  const Pairs pairs(pairs_for(unknowns), scene.with(friction, more), scene.with(0, more), step_time);
  row(fmt::format("| {} | {} | {:.0f} | {}{} | {} | {:.2f} | {:.2f} |", scene.name, levels, pairs.first.unknowns,
                  list(pairs.first.cycles), pairs.first.solved ? "" : " (not solved)", list(pairs.second.cycles),
                  static_cast<double>(pairs.first.most_cycles()) / pairs.second.most_cycles(), pairs.ratio));
}

void print_without_friction(bool quick) {
  fmt::print(
      "\n## `friction = 0` over plain contact\n\n| scene | unknowns | cycles | of contact | time over contact |\n"
      "| --- | --- | --- | --- | --- |\n");
  const auto compare = [](const FrictionScene& scene, int count) {
    Scene contact = scene.with(0);
    for (Scene::Obstacle& obstacle : contact.obstacles) {
      obstacle.type = "contact";
      std::erase_if(obstacle.options.entries, [](const auto& entry) { return entry.first == "friction"; });
    }
    const Pairs pairs(count, scene.with(0), contact, whole_time);
    row(fmt::format("| {} | {:.0f} | {} | {} | {:.2f} |", scene.name, pairs.first.unknowns, list(pairs.first.cycles),
                    list(pairs.second.cycles), pairs.ratio));
  };
  compare(plane_steps(6, 1), 15);
  compare(plane_steps(quick ? 6 : 7, 1), 11);
  compare(space_steps(3, 1), 15);
  if (!quick) compare(space_steps(4, 1), 9);
}

/// Ends a solve once it has used so many seconds of processor time, and the step of its method is over.
class TimeLimit final : public Progress {
 public:
  explicit TimeLimit(double seconds) : seconds_(seconds) {}
  bool interrupted() const override { return elapsed() > seconds_; }
  double elapsed() const { return time_.elapsed(); }

 private:
  ProcessorTime time_;
  double seconds_;
};

struct Solved {
  Steps steps;
  std::vector<double> u;
  bool stopped = false;

  double seconds() const { return steps.seconds[0]; }
};

/// A scene with one step.
Solved solve_within(double seconds, const Scene& scene) {
  Solved out;
  const TimeLimit time(seconds);
  Driver driver(scene, time);
  try {
    const Summary& summary = driver.solve().last().summary;
    out.steps.seconds = {time.elapsed()};
    out.steps.cycles = {summary.iterations};
    out.steps.unknowns = summary.level_unknowns.back();
    out.steps.solved = summary.converged();
    out.u = driver.solution();
  } catch (const Error& error) {
    if (error.status() != Exit::interrupted) throw;
    out.steps.seconds = {time.elapsed()};
    out.stopped = true;
  }
  return out;
}

/// The largest difference over the largest entry.
double difference(const std::vector<double>& u, const std::vector<double>& other) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    largest = std::max(largest, std::abs(u[i]));
    apart = std::max(apart, std::abs(u[i] - other[i]));
  }
  return apart / largest;
}

/// Newton's method is not waited for longer than tells that it is far slower.
void beside_newton(const FrictionScene& scene) {
  constexpr double patience = 100;  // times the time of the cycles
  const Solved cycles = solve_within(infinity, scene.with(0.3));
  const Solved newton = solve_within(patience * cycles.seconds(), scene.with(0.3, {"solver.method=newton"}));
  const double ratio = newton.seconds() / cycles.seconds();
  const std::string start = fmt::format("| {} | {:.0f} | {}{} |", scene.name, cycles.steps.unknowns,
                                        cycles.steps.cycles[0], cycles.steps.solved ? "" : " (not solved)");
  if (newton.stopped) return row(fmt::format("{} stopped | more than {:.0f} | |", start, std::floor(ratio)));
  row(fmt::format("{} {}{} | {:.1f} | {:.0e} |", start, newton.steps.cycles[0],
                  newton.steps.solved ? "" : " (not solved)", ratio, difference(cycles.u, newton.u)));
}

}  // namespace

void print_friction_costs(bool quick) {
  fmt::print(
      "## Steps with friction over steps without\n\n| scene | levels | unknowns | cycles per step | without friction | "
      "cycles over | time over |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  const Overrides matrix{"solver.hierarchy=matrix"};
  const auto plane = [](int refinements) { return 2 * 8 * std::pow(4.0, refinements); };
  const auto space = [](int refinements) { return 3 * 16 * std::pow(8.0, refinements); };
  for (int k = 5; k <= (quick ? 6 : 8); ++k) with_and_without("meshes", plane_steps(k, 3), plane(k), {});
  for (int k = 2; k <= (quick ? 3 : 5); ++k) with_and_without("meshes", space_steps(k, 3), space(k), {});
  for (int k = 5; k <= (quick ? 6 : 8); ++k) with_and_without("matrix", plane_steps(k, 3), plane(k), matrix);
  for (int k = 2; k <= (quick ? 3 : 5); ++k) with_and_without("matrix", space_steps(k, 3), space(k), matrix);
  print_without_friction(quick);
}

void print_friction_scenes(bool quick) {
  fmt::print(
      "## Steps with friction over steps without, other scenes\n\n| scene | levels | unknowns | cycles per step | "
      "without friction | cycles over | time over "
      "|\n| --- | --- | --- | --- | --- | --- | --- |\n");
  const auto rows = [](FrictionScene (*scene)(int), const char* name, std::initializer_list<int> refinements,
                       const Overrides& more, double friction) {
    for (const int k : refinements) {
      FrictionScene named = scene(k);
      named.name = name;
      with_and_without("meshes", named, 1e5, joined(more, {"steps.count=3"}), friction);
    }
  };
  const auto pushed = [](int k) { return block_2d("", "[\"0.1*t\", -0.03]", k); };
  const auto pressed = [](int k) { return plane_steps(k, 3); };
  const int less = quick ? 1 : 0;
  rows(corner, "floor and wall", {3, 5, 7 - less}, {}, 0.3);
  rows(pushed, "block, pushed three times as far as pressed, 0.7", {4 - less, 6 - less, 8 - less}, {}, 0.7);
  rows(pressed, "block, order 2", {4 - less, 6 - less, 7 - less}, {"body.0.order=2"}, 0.3);
  rows(pressed, "block, Poisson's ratio 0.4999", {4 - less, 6 - less}, {"body.0.poisson=0.4999"}, 0.3);
  rows(ball, "ball", {1 - less, 2 - less}, {}, 0.3);
}

void print_friction_direct(bool quick) {
  fmt::print(
      "## Cycles beside Newton's method with a direct solver\n\n| scene | unknowns | cycles | Newton steps | time of "
      "Newton over cycles | largest difference |\n| --- | --- | --- | --- | --- | --- |\n");
  beside_newton(plane_steps(5, 1));
  if (!quick) beside_newton(plane_steps(7, 1));
  beside_newton(space_steps(2, 1));
  beside_newton(space_steps(3, 1));
  if (quick) return;
  for (const char* cells : {"8, 3, 3", "7, 4, 4"}) {
    FrictionScene large = space_steps(3, 1);
    large.overrides.push_back(fmt::format("body.0.cells=[{}]", cells));
    large.name = fmt::format("block 3D, cells {}", cells);
    beside_newton(large);
  }
}

}  // namespace signorini::bench
