#pragma once
#include <functional>
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"
#include "driver/levels/level_solution.hpp"

namespace signorini {

/// What the next coarser mesh knows of a load step and of the one before.
template <int B>
struct CoarserStep {
  const DiscreteProblem<B>& problem;
  const std::vector<double>& x;         ///< its solution, local coordinates; empty: none
  const std::vector<double>& pressure;  ///< likewise
  const LevelSolution<B>& before;
  const Prolongation& P;  ///< from there

  bool knows_change() const { return !x.empty() && !before.u.empty(); }
};

/// A start for a load step from the solution of the last one: that itself, or with the change that the coarser mesh
/// saw, or one of the given `starts`: of all the one with least energy.
/// @param coarser null: there is none
template <int B>
std::vector<double> start_after(const DiscreteProblem<B>& problem, const LevelSolution<B>& before,
                                const CoarserStep<B>* coarser, std::vector<std::vector<double>> starts);

/// A pressure of the next coarser mesh on this one.
using RefinedPressure = std::function<std::vector<double>(const std::vector<double>&)>;

/// The same with a pressure, of which displacements alone have no energy to compare: from the last step and the change
/// that the coarser mesh saw, or what is there already where that mesh does not know the last step.
template <int B>
void start_with_pressure(const DiscreteProblem<B>& problem, const LevelSolution<B>& before,
                         const CoarserStep<B>* coarser, const RefinedPressure& refined, std::vector<double>& x,
                         std::vector<double>& pressure);

}  // namespace signorini
