#pragma once
#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <vector>

#include "core/algebra/block_matrix.hpp"

/// Views of the project's data in Eigen, for computations that share no code with it.
namespace signorini::test {

template <int B>
Eigen::SparseMatrix<double> sparse(const BlockMatrix<B>& A) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) entries.emplace_back(p * B + i, A.column[k] * B + j, A.at(k)[i * B + j]);
  Eigen::SparseMatrix<double> out(A.size() * B, A.size() * B);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

template <int B>
Eigen::MatrixXd dense(const BlockMatrix<B>& A) {
  return Eigen::MatrixXd(sparse(A));
}

inline Eigen::VectorXd vector(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

/// ||v||_A
template <int B>
double energy_norm(const BlockMatrix<B>& A, const Eigen::VectorXd& v) {
  return std::sqrt(std::max(0.0, v.dot(sparse(A) * v)));
}

}  // namespace signorini::test
