#pragma once
#include <span>

#include "apps/bench/peers/instance.hpp"

namespace signorini::bench {

/// min 1/2 x'Ax - b'x over lower <= x <= upper; no bounds at all where these are empty.
struct QuadraticProgram {
  const SparseRows& A;
  std::span<const double> b, lower, upper;

  double project(std::size_t i, double x) const {
    return lower.empty() ? x : std::min(std::max(x, lower[i]), upper[i]);
  }
  std::vector<double> projected_zero() const;
};

QuadraticProgram bounded(const MatrixProblem& problem);
QuadraticProgram unbounded(const Instance& instance);

/// y = A x
void multiply(const SparseRows& A, const double* x, double* y);
std::vector<double> diagonal(const SparseRows& A);

/// max |x - P(x - D^-1 (Ax - b))| with D = diag A, over its value at P(0): the measure of all solvers in a table.
class NaturalResidual {
 public:
  explicit NaturalResidual(const QuadraticProgram& program);

  double operator()(const double* x) const;

 private:
  double absolute(const double* x) const;

  QuadraticProgram program_;
  std::vector<double> diagonal_;
  double scale_ = 1;
};

/// ||x - x*||_A / ||x*||_A
double energy_error(const SparseRows& A, const std::vector<double>& x, const Reference& reference);

}  // namespace signorini::bench
