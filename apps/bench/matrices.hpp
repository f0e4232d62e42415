#pragma once
#include "core/algebra/sparse_rows.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini::bench {

/// A problem as a matrix and bounds alone, without any mesh: min 1/2 x'Ax - b'x over lower <= x <= upper.
struct MatrixProblem {
  SparseRows A;
  std::vector<double> b, lower, upper;
};

/// What is left of a discrete problem in global coordinates without the vectors whose components are all prescribed.
/// Error(Exit::input) for bounds along directions that are no coordinate axes.
template <int B>
MatrixProblem matrix_problem(const DiscreteProblem<B>& problem);

}  // namespace signorini::bench
