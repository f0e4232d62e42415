#include "methods/sparse_system.hpp"

#include <cmath>

namespace signorini {

template <int B>
SparseSystem<B>::SparseSystem(const BlockMatrix<B>& A, std::unique_ptr<LinearSolver> linear)
    : A_(A), linear_(std::move(linear)), scale_(static_cast<std::size_t>(A.size()) * B) {
  std::vector<Offset> start{0};
  std::vector<Index> row;
  visit_lower_triangle([&](Offset column, Offset r, double) {
    if (column + 1 == std::ssize(start)) start.push_back(start.back());
    row.push_back(static_cast<Index>(r));
    ++start.back();
  });
  linear_->analyse(start, row);
  value_.resize(row.size());
}

// A and its pattern are symmetric: what is to the right of the diagonal in a row is what is below it in the column.
template <int B>
template <class Visit>
void SparseSystem<B>::visit_lower_triangle(const Visit& visit) const {
  for (Index p = 0; p < A_.size(); ++p)
    for (int k = 0; k < B; ++k) {
      const Offset column = Offset{p} * B + k;
      visit(column, column, A_.diagonal(p)[k * B + k]);
      for (Offset m = A_.row[p]; m < A_.row[p + 1]; ++m)
        for (int i = A_.column[m] == p ? k + 1 : 0; A_.column[m] >= p && i < B; ++i)
          visit(column, Offset{A_.column[m]} * B + i, A_.at(m)[k * B + i]);
    }
}

template <int B>
double SparseSystem<B>::diagonal(Offset i) const {
  const auto k = static_cast<int>(i % B);
  return A_.diagonal(static_cast<Index>(i / B))[k * B + k];
}

template <int B>
bool SparseSystem<B>::factorise(const std::vector<char>& held, const std::vector<double>& added) {
  for (std::size_t i = 0; i < scale_.size(); ++i)
    scale_[i] = 1 / std::sqrt(diagonal(static_cast<Offset>(i)) + added[i]);
  auto value = value_.begin();
  visit_lower_triangle([&](Offset column, Offset row, double entry) {
    const bool coupled = !held[row] && !held[column];
    *value++ = row == column ? 1 : coupled ? entry * scale_[row] * scale_[column] : 0;
  });
  ++factorisations_;
  return linear_->factorise(value_, scale_);
}

template <int B>
bool SparseSystem<B>::solve(std::vector<double>& b) {
  for (std::size_t i = 0; i < b.size(); ++i) b[i] *= scale_[i];
  ++solves_;
  if (!linear_->solve(b)) return false;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] *= scale_[i];
  return true;
}

template class SparseSystem<1>;
template class SparseSystem<2>;
template class SparseSystem<3>;

}  // namespace signorini
