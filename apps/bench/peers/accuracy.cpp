#include "apps/bench/peers/accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::bench {

std::vector<double> QuadraticProgram::projected_zero() const {
  std::vector<double> x(b.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = project(i, 0);
  return x;
}

QuadraticProgram bounded(const MatrixProblem& problem) { return {problem.A, problem.b, problem.lower, problem.upper}; }

QuadraticProgram unbounded(const Instance& instance) { return {instance.finest().A, instance.free_load, {}, {}}; }

void multiply(const SparseRows& A, const double* x, double* y) {
  for (Index i = 0; i < A.rows; ++i) {
    double sum = 0;
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) sum += A.value[k] * x[A.column[k]];
    y[i] = sum;
  }
}

std::vector<double> diagonal(const SparseRows& A) {
  std::vector<double> d(static_cast<std::size_t>(A.rows), 0.0);
  for (Index i = 0; i < A.rows; ++i)
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k)
      if (A.column[k] == i) d[i] += A.value[k];
  return d;
}

NaturalResidual::NaturalResidual(const QuadraticProgram& program) : program_(program), diagonal_(diagonal(program.A)) {
  const double at_zero = absolute(program.projected_zero().data());
  if (at_zero > 0) scale_ = at_zero;
}

double NaturalResidual::operator()(const double* x) const { return absolute(x) / scale_; }

double NaturalResidual::absolute(const double* x) const {
  const SparseRows& A = program_.A;
  double largest = 0;
  for (Index i = 0; i < A.rows; ++i) {
    double gradient = -program_.b[i];
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) gradient += A.value[k] * x[A.column[k]];
    const double distance = std::abs(x[i] - program_.project(i, x[i] - gradient / diagonal_[i]));
    if (std::isnan(distance)) return distance;
    largest = std::max(largest, distance);
  }
  return largest;
}

double energy_error(const SparseRows& A, const std::vector<double>& x, const Reference& reference) {
  std::vector<double> e(x.size()), Ae(x.size());
  for (std::size_t i = 0; i < e.size(); ++i) e[i] = x[i] - reference.x[i];
  multiply(A, e.data(), Ae.data());
  double square = 0;
  for (std::size_t i = 0; i < e.size(); ++i) square += e[i] * Ae[i];
  return std::sqrt(square) / reference.norm;
}

}  // namespace signorini::bench
