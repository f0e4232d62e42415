#include "apps/bench/matrices/again.hpp"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "amg/black_box.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/problems.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {

constexpr double by = 1e-3;  // bounds rise by this

/// One solve: its processor time, set-up included, and its cycles.
struct Solve {
  double seconds;
  int cycles;

  explicit Solve(const std::function<Summary()>& solve) {
    const ProcessorTime time;
    cycles = solve().iterations;
    seconds = time.elapsed();
  }
};

void row(const char* solver, double unknowns, const Solve& first, const Solve& second) {
  fmt::print("| {} | {} | {} | {} | {:.2f} |\n", solver, unknowns, first.cycles, second.cycles,
             second.seconds / first.seconds);
  std::fflush(stdout);
}

void driver(const Problem& problem) {
  std::unique_ptr<Driver> driver;
  const auto solve = [&] { return driver->solve().last().summary; };
  const Solve first([&] {
    driver = std::make_unique<Driver>(problem.scene);
    return solve();
  });
  auto& lower = driver->scene().obstacles[0].options.find("lower")->value;
  lower = fmt::format("({}) + {}", std::get<std::string>(lower), by);
  const Solve second(solve);
  row("scene", driver->report().last().summary.level_unknowns.back(), first, second);
}

void black_box(const Problem& problem) {
  MatrixProblem matrix = matrix_problem(discretize<3, 1>(Nodes(build_hierarchy<3>(problem.scene, 1).finest()),
                                                         build_model<1>(problem.scene, 3, problem.registry, 1))
                                            .problem);
  std::unique_ptr<BlackBox> solver;
  std::vector<double> x;
  const auto solve = [&] {
    auto result = solver->solve(matrix.b, matrix.lower, matrix.upper, x);
    x = std::move(result.x);
    return result.summary;
  };
  const Solve first([&] {
    solver = std::make_unique<BlackBox>(matrix.A, 1);
    return solve();
  });
  for (double& bound : matrix.lower) bound += by;
  const Solve second(solve);
  row("matrix and bounds", matrix.A.rows, first, second);
}

}  // namespace

void print_again(bool quick) {
  const Problem problem = benchmark_problem("S3", quick ? 33 : 65);
  fmt::print(
      "\n## A second solve with bounds that have risen by {}, over the first one\n\n| given | unknowns | cycles | "
      "cycles "
      "again | time |\n| --- | --- | --- | --- | --- |\n",
      by);
  driver(problem);
  black_box(problem);
}

}  // namespace signorini::bench
