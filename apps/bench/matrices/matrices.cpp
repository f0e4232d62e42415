#include "apps/bench/matrices/matrices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "core/sdk/block.hpp"

namespace signorini::bench {
namespace {

constexpr Index left_out = -1;

/// Places of the blocks of a row by ascending columns; the matrix has the diagonal first.
template <int B>
std::vector<Offset> ascending(const BlockMatrix<B>& A, Index p) {
  std::vector<Offset> places(static_cast<std::size_t>(A.row[p + 1] - A.row[p]));
  std::iota(places.begin(), places.end(), A.row[p]);
  const auto after = std::find_if(places.begin() + 1, places.end(), [&](Offset k) { return A.column[k] > p; });
  std::rotate(places.begin(), places.begin() + 1, after);
  return places;
}

/// M = N_p A N_r' for the block number k, between p and r.
template <int B>
void global_block(const DiscreteProblem<B>& problem, Index p, Offset k, double* M) {
  double S[B * B];
  const double *Np = problem.frames.dual_at(p), *Nr = problem.frames.dual_at(problem.A.column[k]);
  std::copy_n(problem.A.at(k), B * B, M);
  if (Np) {
    block::multiply<B>(Np, M, S);
    std::copy_n(S, B * B, M);
  }
  if (Nr) {
    block::multiply_transposed<B>(M, Nr, S);
    std::copy_n(S, B * B, M);
  }
}

template <int B>
void add_rows(const DiscreteProblem<B>& problem, Index p, const std::vector<Index>& number, SparseRows& A) {
  double M[B * B];
  const std::vector<Offset> places = ascending(problem.A, p);
  for (int i = 0; i < B; ++i) {
    for (const Offset k : places) {
      const Index q = number[problem.A.column[k]];
      if (q == left_out) continue;
      global_block(problem, p, k, M);
      for (int j = 0; j < B; ++j)
        if (M[i * B + j] != 0) {
          A.column.push_back(q * B + j);
          A.value.push_back(M[i * B + j]);
        }
    }
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }
}

/// Of the components of one vector; `lower` and `upper` get its B bounds in global coordinates.
template <int B>
void add_bounds(const DiscreteProblem<B>& problem, Index p, std::vector<double>& lower, std::vector<double>& upper) {
  lower.resize(lower.size() + B, -infinity);
  upper.resize(upper.size() + B, infinity);
  const Constraints<B>& c = problem.constraints;
  const Index slot = c.slot.empty() ? -1 : c.slot[p];
  if (slot < 0) return;
  const double* N = problem.frames.dual_at(p);
  for (int k = 0; k < B; ++k) {
    double below = c.lower[Offset{slot} * B + k], above = c.upper[Offset{slot} * B + k];
    if (below == -infinity && above == infinity) continue;
    int axis = k;
    for (int i = 0; N && i < B; ++i)
      if (std::abs(N[i * B + k]) > 1 - 1e-12) axis = i;
    const double sign = N ? N[axis * B + k] : 1;
    if (std::abs(sign) <= 1 - 1e-12) input_error("obstacle", "its normals are not those of a coordinate plane");
    if (sign < 0) below = -std::exchange(above, -below);
    lower[lower.size() - B + static_cast<std::size_t>(axis)] = below;
    upper[upper.size() - B + static_cast<std::size_t>(axis)] = above;
  }
}

}  // namespace

template <int B>
std::vector<Index> free_vectors(const DiscreteProblem<B>& problem) {
  std::vector<Index> number;
  Index next = 0;
  constexpr Flags all = (1u << B) - 1;
  for (const Flags fixed : problem.fixed) {
    if (fixed != 0 && fixed != all) input_error("fix", "prescribes a vector in part, expected all of its components");
    number.push_back(fixed == all ? left_out : next++);
  }
  return number;
}

template <int B>
MatrixProblem matrix_problem(const DiscreteProblem<B>& problem) {
  MatrixProblem out;
  const std::vector<Index> number = free_vectors(problem);
  for (Index p = 0; p < problem.A.size(); ++p) {
    if (number[p] == left_out) continue;
    add_rows(problem, p, number, out.A);
    add_bounds(problem, p, out.lower, out.upper);
    const double* b = problem.b.data() + Offset{p} * B;
    double global[B];
    if (const double* N = problem.frames.dual_at(p))
      block::product<B>(N, b, global);
    else
      std::copy_n(b, B, global);
    out.b.insert(out.b.end(), global, global + B);
  }
  out.A.rows = out.A.columns = static_cast<Index>(out.b.size());
  return out;
}

template std::vector<Index> free_vectors(const DiscreteProblem<1>&);
template std::vector<Index> free_vectors(const DiscreteProblem<2>&);
template std::vector<Index> free_vectors(const DiscreteProblem<3>&);
template MatrixProblem matrix_problem(const DiscreteProblem<1>&);
template MatrixProblem matrix_problem(const DiscreteProblem<2>&);
template MatrixProblem matrix_problem(const DiscreteProblem<3>&);

}  // namespace signorini::bench
