#pragma once
#include "core/algebra/sparse_rows.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini::bench {

/// A problem as a matrix and bounds alone, without any mesh: min 1/2 x'Ax - b'x over lower <= x <= upper.
struct MatrixProblem {
  SparseRows A;
  std::vector<double> b, lower, upper;
};

/// Per vector its number among those that are not prescribed, else -1.
/// Error(Exit::input) for vectors prescribed in part.
template <int B>
std::vector<Index> free_vectors(const DiscreteProblem<B>& problem);

/// What is left of a discrete problem in global coordinates without prescribed vectors. The columns of a row
/// ascend. Error(Exit::input) as above, and for bounds along directions that are no coordinate axes.
template <int B>
MatrixProblem matrix_problem(const DiscreteProblem<B>& problem);

}  // namespace signorini::bench
