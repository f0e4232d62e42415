#include "apps/bench/matrices/warm.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "amg/black_box.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/problems.hpp"

namespace signorini::bench {
namespace {

constexpr std::array changes{1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0};

double largest(const std::vector<double>& x) {
  double out = 0;
  for (const double v : x) out = std::max(out, std::abs(v));
  return out;
}

MatrixProblem with_bounds_moved(MatrixProblem problem, double by) {
  for (double& v : problem.lower) v += by;
  return problem;
}

MatrixProblem with_load_scaled(MatrixProblem problem, double by) {
  for (double& v : problem.b) v *= by;
  return problem;
}

struct Solve {
  std::string cycles;
  double seconds;

  Solve(BlackBox& solver, const MatrixProblem& problem, const std::vector<double>& start) {
    const ProcessorTime time;
    const Summary summary = solver.solve(problem.b, problem.lower, problem.upper, start).summary;
    seconds = time.elapsed();
    cycles = fmt::format("{}{}", summary.iterations, summary.converged() ? "" : " (limit)");
  }
};

void compare(const char* name, const char* what, BlackBox& solver, const std::vector<double>& before,
             const std::function<MatrixProblem(double)>& changed) {
  fmt::print("| {} | {} |", name, what);
  for (const double change : changes) {
    const MatrixProblem after = changed(change);
    const Solve warm(solver, after, before), cold(solver, after, {});
    fmt::print(" {}, {} ({:.2f}) |", warm.cycles, cold.cycles, warm.seconds / cold.seconds);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

template <int D, int B>
void compare(const char* name, int nodes) {
  const Problem problem = benchmark_problem(name, nodes);
  const MatrixProblem matrix = matrix_problem(discretize<D, B>(Nodes(build_hierarchy<D>(problem.scene, B).finest()),
                                                               build_model<B>(problem.scene, D, problem.registry, 1))
                                                  .problem);
  BlackBox solver(matrix.A, B);
  const std::vector<double> x = solver.solve(matrix.b, matrix.lower, matrix.upper).x;
  const double size = largest(x);
  const std::string label = fmt::format("{}, {}", name, matrix.A.rows);
  compare(label.c_str(), "bounds up", solver, x, [&](double by) { return with_bounds_moved(matrix, by * size); });
  compare(label.c_str(), "bounds down", solver, x, [&](double by) { return with_bounds_moved(matrix, -by * size); });
  compare(label.c_str(), "load grows", solver, x, [&](double by) { return with_load_scaled(matrix, 1 + by); });
  compare(label.c_str(), "load falls", solver, x, [&](double by) { return with_load_scaled(matrix, 1 - by); });
}

}  // namespace

void print_warm(bool quick) {
  fmt::print(
      "\n## Cycles after a change, from the solution before it and from none (processor time of the first over the "
      "second)\n\n| problem, unknowns | change |");
  for (const double change : changes) fmt::print(" {:g} |", change);
  fmt::print("\n| --- | --- |");
  for (std::size_t k = 0; k < changes.size(); ++k) fmt::print(" --- |");
  fmt::print("\n");
  compare<2, 1>("S2", quick ? 129 : 513);
  compare<3, 1>("S3", quick ? 33 : 65);
  compare<3, 3>("E3", quick ? 17 : 33);
}

}  // namespace signorini::bench
