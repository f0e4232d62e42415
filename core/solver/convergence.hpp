#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Estimates ||x - x*||_A from the energies that the last cycles gained. While the phases rest,
/// gain = J(before) - J(after) = (||e_before||^2 - ||e_after||^2) / 2, and the gains fall geometrically.
class ErrorEstimate {
 public:
  /// @param gain energy decrease of the last cycle
  /// @param correction energy norm of its correction
  void add(double gain, double correction);
  /// Estimate of ||x - x*||_A after the last cycle.
  double error() const { return error_; }
  /// Mean reduction of the correction's energy norm over the last (at most four) cycles; 0 before the second.
  double rate() const;

 private:
  std::vector<double> gains_, corrections_;
  double error_ = 0;
};

/// ||x||_A^2 with the prescribed values counted in, as before their elimination.
template <int B>
double energy_norm_squared(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r);

/// Energy 1/2 a(u, u) - f(u) of the solution x in local coordinates, prescribed values counted in.
/// @param r b - A x
template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x, const std::vector<double>& r);
template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x);

}  // namespace signorini
