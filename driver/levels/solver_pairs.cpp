#include <algorithm>
#include <utility>

#include "core/base/stopwatch.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/levels/nested_solver.hpp"

// Where unknowns of a NestedSolver are jumps between bodies (driver/levels/level_pairs.hpp), as its solutions say.

namespace signorini {

/// Where bodies may touch each other.
template <int D, int B>
void NestedSolver<D, B>::pair_levels(const Model<B>& model) {
  if (D != B || !changes_unknowns(model)) return;
  const Stopwatch watch;
  if (!pairs_.find(model)) drop_algebraic_levels();
  times_.setup += watch.elapsed();
}

/// Unknowns of a mesh are jumps where a solution on the next coarser one nearly touches.
template <int D, int B>
void NestedSolver<D, B>::pair_near_contact(const Model<B>& model, std::size_t level, const Solution<B>& coarse) {
  if (!pairs_.may_narrow(level)) return;
  const Stopwatch watch;
  pairs_.narrow_by_coarser(model, level, to_global(coarse.discretization.problem, coarse.x));
  times_.setup += watch.elapsed();
}

/// Without a coarser mesh a rough solution tells where bodies touch. It need not be one: cycles may be slow with jumps
/// all over, most where bodies are far apart, and whether they touch elsewhere is looked at afterwards.
template <int D, int B>
void NestedSolver<D, B>::come_near(const Model<B>& model, Solution<B>& solution) {
  constexpr double roughly = 1e-3;
  constexpr int a_few = 30;
  if (!pairs_.may_narrow(first_)) return;
  SolverOptions options = options_;
  options.tolerance = std::max(options.tolerance, roughly);
  options.max_iterations = std::min(options.max_iterations, a_few);
  solve_level(model, first_, options, nullptr, solution);
  dropped_.insert(dropped_.end(), solution.summary.stages.begin(), solution.summary.stages.end());
  narrow_first(model, solution);
}

/// Once the coarsest mesh has a solution it is a level like the others.
template <int D, int B>
void NestedSolver<D, B>::narrow_first(const Model<B>& model, Solution<B>& coarse) {
  if (!pairs_.may_narrow(first_)) return;
  const std::vector<double> u = to_global(coarse.discretization.problem, coarse.x);
  if (!pairs_.narrow(model, first_, u)) return;
  drop_algebraic_levels();
  std::vector<double> pressure = std::move(coarse.pressure);
  coarse = discretize_level(model, first_);
  coarse.pressure = std::move(pressure);
  coarse.x = to_local(coarse.discretization.problem, u);
  continue_algebraically(coarse.discretization.problem);
}

/// Interpolation between the meshes up to this one is one between the jumps that they have now.
template <int D, int B>
void NestedSolver<D, B>::connect_jumps(std::size_t level) {
  const Stopwatch watch;
  pairs_.connect(level, matrices_.between_meshes());
  times_.setup += watch.elapsed();
}

/// Where bodies touch each other elsewhere than was thought, the problem with jumps there as well, and the solution as
/// a start.
template <int D, int B>
bool NestedSolver<D, B>::pair_more(const Model<B>& model, Solution<B>& solution) {
  const std::size_t finest = levels_.size() - 1;
  if (!pairs_.at(finest)) return false;
  const std::vector<double> u = to_global(solution.discretization.problem, solution.x);
  if (!pairs_.widen(model, u)) return false;
  connect_jumps(finest);
  Solution<B> next = discretize_level(model, finest);
  next.x = to_local(next.discretization.problem, u);
  make_admissible(next.discretization.problem, next.x);
  next.summary = std::move(solution.summary);
  next.pressure = std::move(solution.pressure);
  next.joints = std::move(solution.joints);
  solution = std::move(next);
  return true;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                      \
  template void NestedSolver<D, B>::pair_levels(const Model<B>&);                                        \
  template void NestedSolver<D, B>::pair_near_contact(const Model<B>&, std::size_t, const Solution<B>&); \
  template void NestedSolver<D, B>::come_near(const Model<B>&, Solution<B>&);                            \
  template void NestedSolver<D, B>::narrow_first(const Model<B>&, Solution<B>&);                         \
  template void NestedSolver<D, B>::connect_jumps(std::size_t);                                          \
  template bool NestedSolver<D, B>::pair_more(const Model<B>&, Solution<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
