#include "amg/unit_diagonal.hpp"

#include <cmath>

namespace signorini {

template <int B>
Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<B>& A, const std::vector<Flags>& mask,
                                               std::vector<double>& scale) {
  const Index n = A.size() * B;
  scale.assign(static_cast<std::size_t>(n), 0.0);
  for (Index p = 0; p < A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (!(mask[p] >> k & 1u)) scale[p * B + k] = 1 / std::sqrt(A.diagonal(p)[k * B + k]);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(A.value.size() / 2 + static_cast<std::size_t>(n));
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) {
          const Index row = p * B + i, column = A.column[k] * B + j;
          if (row < column) continue;
          const double value = A.at(k)[i * B + j] * scale[row] * scale[column];
          entries.emplace_back(row, column, row == column ? 1 : value);
        }
  Eigen::SparseMatrix<double> S(n, n);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

template Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<1>&, const std::vector<Flags>&,
                                                        std::vector<double>&);
template Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<2>&, const std::vector<Flags>&,
                                                        std::vector<double>&);
template Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<3>&, const std::vector<Flags>&,
                                                        std::vector<double>&);

}  // namespace signorini
