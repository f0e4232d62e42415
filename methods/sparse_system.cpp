#include "methods/sparse_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/sdk/block.hpp"

namespace signorini {

template <int B>
SparseSystem<B>::SparseSystem(const BlockMatrix<B>& A, std::unique_ptr<LinearSolver> linear)
    : A_(A), linear_(std::move(linear)), change_(A.size()), scale_(static_cast<std::size_t>(A.size()) * B, 1.0) {
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

// Block m of A's entries, in row p, as the change has it.
template <int B>
void SparseSystem<B>::changed_block(Index p, Offset m, double* M) const {
  const Index q = A_.column[m];
  std::copy_n(A_.at(m), B * B, M);
  double half[B * B];
  if (const double* T = change_.turned.at(p)) {
    block::transposed_multiply<B>(T, M, half);
    std::copy_n(half, B * B, M);
  }
  if (const double* T = change_.turned.at(q)) {
    block::multiply<B>(M, T, half);
    std::copy_n(half, B * B, M);
  }
  for (int i = 0; p == q && i < B; ++i) M[i * (B + 1)] += change_.added[Offset{p} * B + i];
}

// A and its pattern are symmetric: what is to the right of the diagonal in a row is what is below it in the column.
template <int B>
template <class Visit>
void SparseSystem<B>::visit_lower_triangle(const Visit& visit) const {
  std::vector<double> row;  // of blocks
  for (Index p = 0; p < A_.size(); ++p) {
    const Offset first = A_.row[p], last = A_.row[p + 1];
    row.resize(static_cast<std::size_t>(last - first) * B * B);
    for (Offset m = first; m < last; ++m)
      if (A_.column[m] >= p) changed_block(p, m, row.data() + (m - first) * B * B);
    for (int k = 0; k < B; ++k) {
      const Offset column = Offset{p} * B + k;
      visit(column, column, row[static_cast<std::size_t>(k) * (B + 1)]);
      for (Offset m = first; m < last; ++m)
        for (int i = A_.column[m] == p ? k + 1 : 0; A_.column[m] >= p && i < B; ++i)
          visit(column, Offset{A_.column[m]} * B + i, row[static_cast<std::size_t>(((m - first) * B + k) * B + i)]);
    }
  }
}

template <int B>
double SparseSystem<B>::diagonal(Offset i) const {
  const auto k = static_cast<int>(i % B);
  return A_.diagonal(static_cast<Index>(i / B))[k * B + k];
}

template <int B>
bool SparseSystem<B>::factorise() {
  for (Index p = 0; p < A_.size(); ++p) {
    double M[B * B];
    changed_block(p, A_.row[p], M);
    for (int k = 0; k < B; ++k) scale_[Offset{p} * B + k] = 1 / std::sqrt(M[k * (B + 1)]);
  }
  auto value = value_.begin();
  visit_lower_triangle([&](Offset column, Offset row, double entry) {
    const bool coupled = !change_.held[row] && !change_.held[column];
    *value++ = row == column ? 1 : coupled ? entry * scale_[row] * scale_[column] : 0;
  });
  ++factorisations_;
  return linear_->factorise(value_, scale_);
}

template <int B>
bool SparseSystem<B>::solve(std::vector<double>& b) {
  turn(b, block::transposed_product<B>);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = change_.held[i] ? 0 : b[i] * scale_[i];
  ++solves_;
  if (!linear_->solve(b)) return false;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] *= scale_[i];
  turn(b, block::product<B>);
  return true;
}

template <int B>
template <class Turn>
void SparseSystem<B>::turn(std::vector<double>& b, const Turn& turn) const {
  for (Index p = 0; p < A_.size(); ++p)
    if (const double* T = change_.turned.at(p)) {
      double turned[B];
      turn(T, b.data() + Offset{p} * B, turned);
      std::copy_n(turned, B, b.data() + Offset{p} * B);
    }
}

template class SparseSystem<1>;
template class SparseSystem<2>;
template class SparseSystem<3>;

}  // namespace signorini
