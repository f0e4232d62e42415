#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "driver/levels/moved_problem.hpp"
#include "driver/levels/nested_solver.hpp"

// Pressure that acts where contact is open (core/fem/recovery/joint_pressure.hpp), in the solves of a NestedSolver.

namespace signorini {

/// Makes what pressure exerts in joints part of the load on the finest mesh, in place of what it exerted before.
/// @param discretization there; null: it is yet to come, and takes the load then
template <int D, int B>
JointLoad<B> NestedSolver<D, B>::fill_joints(const JointPressure<D, B>& joints, const Wetted& wetted,
                                             Discretization<B>* discretization) {
  MeshLevel<D, B>& finest = levels_.finest();
  JointLoad<B> out = joints.load(wetted, finest.all_pairs.get());
  if (discretization) {
    add_force(finest.force, -1, discretization->load);
    add_force(out.force, 1, discretization->load);
    place_loads(*discretization);
  } else if (finest.kept) {
    add_force(finest.force, -1, finest.kept->discretization.load);  // back to the model's own
  }
  finest.force = out.force;
  return out;
}

/// Pressure spreads in joints as far as they are open, which they are where it acts. Each solve begins where the last
/// one ended, and is a rough one as long as what is reached changes.
template <int D, int B>
void NestedSolver<D, B>::solve_open(const Model<B>& model, const JointPressure<D, B>& joints, Spreading& spreading,
                                    Solution<B>& solution) {
  constexpr double roughly = 1e-3;
  constexpr int enough = 100;
  SolverOptions options = options_;
  options.tolerance = std::max(options.tolerance, roughly);
  std::vector<Stage> before;
  const auto solve = [&] {
    try {
      solve_finest(model, options, solution);
    } catch (const Error& error) {
      const std::string origin = joints.origin(spreading.now());
      if (error.status() != Exit::no_solution || origin.empty()) throw;
      throw Error(error.status(),
                  fmt::format("{}; the pressure of {} acts where contact is open", error.what(), origin));
    }
    solution.summary.put_in_front(std::exchange(before, {}));
  };
  for (int k = 0; k < enough; ++k) {
    solve();
    if (!solution.summary.converged() || progress_.is_ended()) return;
    const bool moved = spreading.take(joints.wetted(solution.discretization, solution.x, solution.joints));
    if (!moved && options.tolerance <= options_.tolerance) {
      solution.pressed_shut = spreading.shut();
      return;
    }
    before = std::move(solution.summary.stages);
    if (moved)
      solution.joints = fill_joints(joints, spreading.now(), &solution.discretization);
    else
      options.tolerance = options_.tolerance;
  }
  solution.summary.put_in_front(std::move(before));
  solution.summary.outcome = Outcome::stuck;
  solution.summary.reason = fmt::format("after {} solves the pressure of {} still spreads in what is open", enough,
                                        joints.origin(spreading.now()));
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                \
  template JointLoad<B> NestedSolver<D, B>::fill_joints(const JointPressure<D, B>&, const Wetted&, \
                                                        Discretization<B>*);                       \
  template void NestedSolver<D, B>::solve_open(const Model<B>&, const JointPressure<D, B>&, Spreading&, Solution<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
