#pragma once
#include "core/algebra/two_doubles.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Components of a problem that are prescribed for a while: what the rows of its matrix were before.
template <int B>
class HeldRows {
 public:
  /// From now on these components are prescribed, and those before no longer: problem.fixed. Their rows and columns are
  /// those of the identity after the next prescribe().
  void hold(DiscreteProblem<B>& problem, std::vector<Flags> fixed);

  /// Eliminates the values that problem.start has for the components that are held.
  /// @param problem its b holds the forces of all components, and afterwards what eliminate() says
  void prescribe(DiscreteProblem<B>& problem) const;

  /// r = A x - b with the matrix as it was before, on the rows that are held or coupled to those.
  void residual(const DiscreteProblem<B>& problem, const double* x, const double* b, double* r) const;
  /// r = b - A x there, exactly but for the last rounding.
  void residual(const DiscreteProblem<B>& problem, const TwoDoubles* x, const double* b, long double* r) const;

 private:
  void put_back(BlockMatrix<B>& A) const;

  std::vector<Index> vectors_;  // ascending: with components that are held, or coupled to such ones
  std::vector<double> value_;   // of their rows, one after the other
};

}  // namespace signorini
