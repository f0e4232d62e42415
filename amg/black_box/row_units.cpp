#include "amg/black_box/row_units.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini {
namespace {

constexpr double alike = 4;        // largest diagonal entry over the smallest one, up to which units hardly matter
constexpr double much_less = 0.1;  // row sums that s leaves, over those of constants
// Other units round the entries. Chains, trees and few rows may be so badly conditioned that this shows, and need no
// levels.
constexpr Index few_rows = 400;
constexpr Offset entries_of_a_tree = 4;  // per row

/// 1 / sqrt(a_ii), and 1 for rows without entries; empty where one is negative, or all are alike.
std::vector<double> of_diagonal(const SparseRows& A) {
  std::vector<double> diagonal(static_cast<std::size_t>(A.rows), 0.0);
  for (Index i = 0; i < A.rows; ++i)
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k)
      if (A.column[k] == i) diagonal[i] += A.value[k];
  double least = infinity, largest = 0;
  for (Index i = 0; i < A.rows; ++i) {
    double& d = diagonal[i];
    if (A.row[i] == A.row[i + 1]) {
      d = 1;
      continue;
    }
    if (!(d > 0 && d < infinity)) return {};
    least = std::min(least, d);
    largest = std::max(largest, d);
    d = 1 / std::sqrt(d);
  }
  if (!(largest > alike * least)) return {};
  return diagonal;
}

/// The median over the rows of |sum_j a_ij v_j| / (a_ii v_i), where a_ii = 1 / s_i^2.
template <class Value>
double median_sum(const SparseRows& A, const std::vector<double>& s, const Value& v) {
  std::vector<double> sums(s.size());
  for (Index i = 0; i < A.rows; ++i) {
    double sum = 0;
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) sum += A.value[k] * v(A.column[k]);
    sums[i] = std::fabs(sum) * s[i] * s[i] / v(i);
    if (std::isnan(sums[i])) return 0;
  }
  const auto middle = sums.begin() + std::ssize(sums) / 2;
  std::nth_element(sums.begin(), middle, sums.end());
  return *middle;
}

}  // namespace

std::vector<double> recognised_units(const SparseRows& A) {
  if (!is_square(A) || A.rows <= few_rows || std::ssize(A.value) <= entries_of_a_tree * A.rows) return {};
  std::vector<double> s = of_diagonal(A);
  if (s.empty()) return {};
  const double left = median_sum(A, s, [&](Index j) { return s[j]; });
  const double by_constants = median_sum(A, s, [](Index) { return 1.0; });
  if (!(left < much_less * by_constants)) return {};
  return s;
}

SparseRows in_units(SparseRows A, const std::vector<double>& units) {
  for (Index i = 0; i < A.rows; ++i)
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) A.value[k] *= units[i] * units[A.column[k]];
  return A;
}

}  // namespace signorini
