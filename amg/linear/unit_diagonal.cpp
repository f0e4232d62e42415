#include "amg/linear/unit_diagonal.hpp"

#include <cmath>

namespace signorini {

namespace {

/// @param factor s_i for a_ii
/// @param diagonal of the result, for s_i a_ii s_i
template <int B, class Factor, class Diagonal>
Eigen::SparseMatrix<double> scaled(const BlockMatrix<B>& A, const std::vector<Flags>& mask, std::vector<double>& scale,
                                   const Factor& factor, const Diagonal& diagonal) {
  const Index n = A.size() * B;
  scale.assign(static_cast<std::size_t>(n), 0.0);
  for (Index p = 0; p < A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (!(mask[p] >> k & 1u)) scale[p * B + k] = factor(A.diagonal(p)[k * B + k]);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(A.value.size() / 2 + static_cast<std::size_t>(n));
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) {
          const Index row = p * B + i, column = A.column[k] * B + j;
          if (row < column) continue;
          const double value = A.at(k)[i * B + j] * scale[row] * scale[column];
          entries.emplace_back(row, column, row == column ? diagonal(value) : value);
        }
  Eigen::SparseMatrix<double> S(n, n);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

}  // namespace

template <int B>
Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<B>& A, const std::vector<Flags>& mask,
                                               std::vector<double>& scale) {
  return scaled(
      A, mask, scale, [](double a) { return 1 / std::sqrt(a); }, [](double) { return 1.0; });
}

template <int B>
Eigen::SparseMatrix<double> scaled_exactly(const BlockMatrix<B>& A, const std::vector<Flags>& mask,
                                           std::vector<double>& scale) {
  return scaled(
      A, mask, scale, [](double a) { return std::exp2(-std::round(0.5 * std::log2(a))); },
      [](double value) { return value > 0 ? value : 1.0; });
}

#define SIGNORINI_INSTANTIATE(B)                                                                            \
  template Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<B>&, const std::vector<Flags>&, \
                                                          std::vector<double>&);                            \
  template Eigen::SparseMatrix<double> scaled_exactly(const BlockMatrix<B>&, const std::vector<Flags>&,     \
                                                      std::vector<double>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
