#pragma once
#include <array>
#include <utility>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/obstacles.hpp"
#include "tests/support/random.hpp"

/// Problems without any geometry behind them, to test what is purely algebraic.
namespace signorini::test {

/// A random orthogonal matrix, row-major.
template <int B>
std::array<double, B * B> random_rotation(Random& random);

/// Sum of random semidefinite couplings along a random graph, and a definite shift: symmetric to the last bit.
template <int B>
BlockMatrix<B> random_matrix(Random& random, Index n, int edges_per_vector = 3, double shift = 0.05);

/// One of: free, one-sided, two-sided, lower = upper.
std::pair<double, double> random_interval(Random& random, double around, double width);

/// A random problem in local coordinates: the given part of the vectors is constrained.
template <int B>
DiscreteProblem<B> random_problem(Random& random, Index n, double constrained = 0.6);

/// Random frames at about half of the vectors, every other one oblique.
template <int B>
Frames<B> random_frames(Random& random, Index n);

/// Interpolation with weights of any sign that do not sum to one; the first fine vectors are twins of the coarse ones.
Prolongation random_prolongation(Random& random, Index coarse, Index fine);

}  // namespace signorini::test
