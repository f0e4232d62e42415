#pragma once
#include <algorithm>

#include "tests/amg/matrices.hpp"

/// Matrices of fourth order.
namespace signorini::test {

/// The square of the five-point stencil on so many inner nodes a side, 13 points: a plate, simply supported, or clamped
/// where values are reflected about the boundary.
inline Eigen::SparseMatrix<double> plate(int nodes, bool clamped) {
  const Eigen::SparseMatrix<double> L = laplacian(nodes + 1);
  Eigen::SparseMatrix<double> A = L * L;
  const auto ends = [=](int i) { return (i == 0) + (i == nodes - 1); };
  for (int i = 0; clamped && i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) A.coeffRef(i * nodes + j, i * nodes + j) += 2 * (ends(i) + ends(j));
  return A;
}

/// Second differences squared, with so much on the diagonal: 6 is a clamped beam, and CUTEst's CHENHARK.
inline Eigen::SparseMatrix<double> five_diagonals(int n, double diagonal) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(i - 2, 0); j <= std::min(i + 2, n - 1); ++j)
      entries.emplace_back(i, j, i == j ? diagonal : std::abs(i - j) == 1 ? -4 : 1);
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace signorini::test
