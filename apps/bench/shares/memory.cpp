#include "apps/bench/shares/memory.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <fstream>

#include "apps/bench/problems.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

/// Bytes by the name of a line of /proc/self/status.
double status_of_memory(const std::string& wanted) {
  std::ifstream status("/proc/self/status");
  std::string name;
  for (double kilobytes = 0; status >> name; status.ignore(1000, '\n'))
    if (name == wanted && status >> kilobytes) return kilobytes * 1024;
  input_error("/proc/self/status", "has no line " + wanted);
}

}  // namespace

double begin_measuring() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  const double now = status_of_memory("VmRSS:");
  if (status_of_memory("VmHWM:") > 1.05 * now) input_error("/proc/self/clear_refs", "does not reset the peak");
  return now;
}

double peak_memory() { return status_of_memory("VmHWM:"); }

namespace {

template <int B>
double bytes(const BlockMatrix<B>& A) {
  return static_cast<double>(A.row.size() * sizeof(Offset) + A.column.size() * sizeof(Index) +
                             A.value.size() * sizeof(double));
}

void row(int nodes) {
  const Problem problem = benchmark_problem("E3", nodes);
  const MeshHierarchy<3> hierarchy = build_hierarchy<3>(problem.scene, 3);
  const double before = begin_measuring();
  const Solved solved = solve_nonlinear<3, 3>(problem, hierarchy);
  const double peak = peak_memory();
  const auto finest =
      discretize<3, 3>(Nodes(hierarchy.finest()), build_model<3>(problem.scene, 3, problem.registry, 1));
  const double matrix = bytes(finest.problem.A);
  fmt::print("| E3 | {:.0f} | {:.1f} | {:.1f} | {:.2f} | {:.1f} |\n", solved.unknowns(), matrix / 1e6,
             (peak - before) / 1e6, (peak - before) / matrix, before / 1e6);
}

}  // namespace

void print_memory(bool quick) {
  fmt::print(
      "\n## Memory\n\n| problem | unknowns | finest matrix, MB | solver's peak, MB | over the matrix | before, with "
      "the "
      "meshes, MB |\n| --- | --- | --- | --- | --- | --- |\n");
  row(quick ? 17 : 33);
  if (!quick) row(65);
}

}  // namespace signorini::bench
