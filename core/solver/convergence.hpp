#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/summary.hpp"

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
  /// The same by the steps alone, which fall geometrically, too, where the energy changes from cycle to cycle.
  double error_of_steps() const;
  /// Mean reduction of the correction's energy norm over the last (at most four) cycles with one above rounding;
  /// `unknown_rate` before the second of them.
  double rate() const;

 private:
  std::vector<double> gains_, corrections_;
  double error_ = 0;
};

/// Sums over the free components, from the residual r = b - A x: there A and b are without the prescribed values.
struct FreeProducts {
  double xAx = 0, bx = 0;

  FreeProducts& operator+=(const FreeProducts& other) {
    xAx += other.xAx;
    bx += other.bx;
    return *this;
  }
};

/// Of the vectors first <= p < last.
template <int B>
FreeProducts free_products(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r, Index first, Index last);

/// ||x||_A^2 with the prescribed values counted in, as before their elimination.
template <int B>
double energy_norm_squared(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const FreeProducts& products);
template <int B>
double energy_norm_squared(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r);

/// Energy 1/2 a(u, u) - f(u) of the solution in local coordinates, prescribed values counted in.
template <int B>
double energy(const DiscreteProblem<B>& problem, const FreeProducts& products);
template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x);

}  // namespace signorini
