#pragma once
#include "tests/core/solver/cases.hpp"
#include "tests/support/dense.hpp"

/// Problems as other codes hand them over: matrices and bounds.
namespace signorini::test {

/// A matrix of the five-point stencil on a square of nodes, its diagonal from `diagonal(number of neighbours)`.
template <class Diagonal>
Eigen::SparseMatrix<double> five_point(int nodes, Diagonal&& diagonal) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto in = [=](int i, int j) { return i >= 0 && j >= 0 && i < nodes && j < nodes; };
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) {
      int neighbours = 0;
      for (const auto& [di, dj] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        if (in(i + di, j + dj)) {
          ++neighbours;
          entries.emplace_back(i * nodes + j, (i + di) * nodes + j + dj, -1);
        }
      entries.emplace_back(i * nodes + j, i * nodes + j, diagonal(neighbours));
    }
  Eigen::SparseMatrix<double> A(nodes * nodes, nodes * nodes);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// On the inner nodes of a square with so many cells a side, zero on the boundary.
inline Eigen::SparseMatrix<double> laplacian(int cells) {
  return five_point(cells - 1, [](int) { return 4; });
}

/// The graph Laplacian of all nodes: semidefinite.
inline Eigen::SparseMatrix<double> neumann_laplacian(int cells) {
  return five_point(cells + 1, [](int neighbours) { return neighbours; });
}

/// So many bodies that nothing couples, each with the matrix A.
inline Eigen::SparseMatrix<double> copies(int bodies, const Eigen::SparseMatrix<double>& A) {
  const Eigen::Index n = A.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (int body = 0; body < bodies; ++body)
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(A, k); entry; ++entry)
        entries.emplace_back(body * n + entry.row(), body * n + k, entry.value());
  Eigen::SparseMatrix<double> out(bodies * n, bodies * n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

inline std::vector<double> waves(std::size_t n) {
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = std::sin(0.1 * static_cast<double>(i));
  return out;
}

/// A problem without its structure.
template <int B>
struct Given {
  Eigen::SparseMatrix<double> A;
  std::vector<double> b, lower, upper;

  explicit Given(const DiscreteProblem<B>& problem)
      : A(sparse(problem.A)), b(problem.b), lower(b.size(), -infinity), upper(b.size(), infinity) {
    const Constraints<B>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        const Offset i = Offset{c.vector[slot]} * B + k;
        if (problem.fixed[c.vector[slot]] >> k & 1u) continue;  // the row holds the value
        lower[i] = c.lower[slot * B + k];
        upper[i] = c.upper[slot * B + k];
      }
  }
};

/// The other way round, for the reference solver: without bounds, b = 0.
inline DiscreteProblem<1> problem_of(const Eigen::SparseMatrix<double>& A) {
  DiscreteProblem<1> problem;
  for (Index p = 0; p < A.rows(); ++p) {
    problem.A.column.push_back(p);
    problem.A.value.push_back(A.coeff(p, p));
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, p); entry; ++entry)
      if (entry.row() != p) {
        problem.A.column.push_back(static_cast<Index>(entry.row()));
        problem.A.value.push_back(entry.value());
      }
    problem.A.row.push_back(static_cast<Offset>(problem.A.column.size()));
  }
  const auto n = static_cast<std::size_t>(A.rows());
  problem.b.assign(n, 0);
  problem.fixed.assign(n, 0);
  problem.start.assign(n, 0);
  return problem;
}

inline void bound(DiscreteProblem<1>& problem, const std::vector<double>& lower, const std::vector<double>& upper) {
  Constraints<1>& c = problem.constraints;
  c.lower = lower;
  c.upper = upper;
  c.slot.resize(lower.size());
  for (Index p = 0; p < static_cast<Index>(lower.size()); ++p) c.slot[p] = p;
  c.vector = c.slot;
}

}  // namespace signorini::test
