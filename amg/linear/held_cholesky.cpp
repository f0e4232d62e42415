#include "amg/linear/held_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <span>

namespace signorini {

template <class Real>
bool BasicHeldCholesky<Real>::factorise(const Eigen::SparseMatrix<double>& S, double most_operations, Real no_pivot) {
  if (!has_known_pattern(S)) {
    Eigen::AMDOrdering<int>()(S.selfadjointView<Eigen::Lower>(), inverse_);
    order_ = inverse_.inverse();
  }
  Upper reordered(S.rows(), S.cols());
  reordered.selfadjointView<Eigen::Upper>() = S.selfadjointView<Eigen::Lower>().twistedBy(order_);
  held_.clear();
  falling_ = -1;
  if (analyse(reordered) > most_operations) {
    pivot_.clear();
    return false;
  }
  row_.resize(static_cast<std::size_t>(start_.back()));
  value_.resize(row_.size());
  const auto n = static_cast<int>(S.rows());
  pivot_.resize(static_cast<std::size_t>(n));
  std::vector<int> seen(static_cast<std::size_t>(n), -1);
  std::vector<Real> y(static_cast<std::size_t>(n), 0);
  for (int k = 0; k < n; ++k) {
    factorise_row(reordered, k, seen, y);
    if (pivot_[k] > no_pivot) continue;
    if (pivot_[k] < -no_pivot && falling_ < 0) falling_ = k;
    pivot_[k] = 1;
    held_.push_back(inverse_.indices()[k]);
  }
  return true;
}

// Whether it is that of the last matrix, whose order then serves again; if not, it is kept in mind.
template <class Real>
bool BasicHeldCholesky<Real>::has_known_pattern(const Eigen::SparseMatrix<double>& S) {
  const std::span column(S.outerIndexPtr(), static_cast<std::size_t>(S.cols()) + 1);
  const std::span row(S.innerIndexPtr(), static_cast<std::size_t>(S.nonZeros()));
  if (std::ranges::equal(column, pattern_start_) && std::ranges::equal(row, pattern_row_)) return true;
  pattern_start_.assign(column.begin(), column.end());
  pattern_row_.assign(row.begin(), row.end());
  return false;
}

// The elimination tree and how many entries the columns of L have: row k of L has one in each column on the way from an
// entry of S in that row up to k. Returns the multiplications that it takes to find them.
template <class Real>
double BasicHeldCholesky<Real>::analyse(const Upper& S) {
  const auto n = static_cast<int>(S.rows());
  parent_.assign(static_cast<std::size_t>(n), -1);
  start_.assign(static_cast<std::size_t>(n) + 1, 0);
  std::vector<int> seen(static_cast<std::size_t>(n), -1);
  for (int k = 0; k < n; ++k) {
    seen[k] = k;
    for (Upper::InnerIterator entry(S, k); entry; ++entry)
      for (auto i = static_cast<int>(entry.row()); i < k && seen[i] != k; i = parent_[i]) {
        if (parent_[i] < 0) parent_[i] = k;
        seen[i] = k;
        ++start_[i + 1];
      }
  }
  double operations = 0;
  for (int k = 0; k < n; ++k) {
    operations += 0.5 * static_cast<double>(start_[k + 1]) * static_cast<double>(start_[k + 1]);
    start_[k + 1] += start_[k];
  }
  end_.assign(start_.begin(), start_.end() - 1);
  row_.clear();
  value_.clear();
  return operations;
}

// Row k of L from a triangular solve with the rows above it. Children in the tree come before their parents.
// @param y zero, before and after
template <class Real>
void BasicHeldCholesky<Real>::factorise_row(const Upper& S, int k, std::vector<int>& seen, std::vector<Real>& y) {
  pattern_.clear();
  seen[k] = k;
  pivot_[k] = 0;
  for (Upper::InnerIterator entry(S, k); entry; ++entry) {
    const auto row = static_cast<int>(entry.row());
    if (row == k) pivot_[k] += entry.value();
    if (row >= k) continue;
    y[row] += entry.value();
    path_.clear();
    for (int i = row; seen[i] != k; i = parent_[i]) {
      path_.push_back(i);
      seen[i] = k;
    }
    pattern_.insert(pattern_.end(), path_.rbegin(), path_.rend());
  }
  for (auto column = pattern_.rbegin(); column != pattern_.rend(); ++column) {
    const int i = *column;
    const Real below = y[i], entry = below / pivot_[i];
    y[i] = 0;
    for (Eigen::Index m = start_[i]; m < end_[i]; ++m) y[row_[m]] -= value_[m] * below;
    pivot_[k] -= entry * below;
    row_[end_[i]] = k;
    value_[end_[i]++] = entry;
  }
}

template <class Real>
typename BasicHeldCholesky<Real>::Vector BasicHeldCholesky<Real>::solve(const Vector& b) const {
  Vector x = order_ * b;
  const Eigen::Index n = size();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index m = start_[i]; m < end_[i]; ++m) x[row_[m]] -= value_[m] * x[i];
  for (Eigen::Index i = 0; i < n; ++i) x[i] /= pivot_[i];
  solve_transposed(x);
  return order_.inverse() * x;
}

template <class Real>
Real BasicHeldCholesky<Real>::smallest_pivot() const {
  return pivot_.empty() ? 1 : *std::min_element(pivot_.begin(), pivot_.end());  // 1 where held
}

// The rows of L below the pivot have no part in it; pivots that were replaced may have made them infinite.
template <class Real>
typename BasicHeldCholesky<Real>::Vector BasicHeldCholesky<Real>::falling_direction() const {
  if (falling_ < 0) return {};
  Vector x = Vector::Unit(size(), falling_);
  for (Eigen::Index i = falling_ - 1; i >= 0; --i)
    for (Eigen::Index m = start_[i]; m < end_[i] && row_[m] <= falling_; ++m) x[i] -= value_[m] * x[row_[m]];
  return order_.inverse() * x;
}

// x = L^-T x
template <class Real>
void BasicHeldCholesky<Real>::solve_transposed(Vector& x) const {
  for (Eigen::Index i = size() - 1; i >= 0; --i) {
    Real sum[4] = {};  // that do not wait for each other
    Eigen::Index m = start_[i];
    for (; m + 4 <= end_[i]; m += 4)
      for (int k = 0; k < 4; ++k) sum[k] += value_[m + k] * x[row_[m + k]];
    for (; m < end_[i]; ++m) sum[0] += value_[m] * x[row_[m]];
    x[i] -= (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
}

template class BasicHeldCholesky<double>;
template class BasicHeldCholesky<long double>;

}  // namespace signorini
