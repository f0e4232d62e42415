#include "methods/direct_newton_system.hpp"

#include <algorithm>
#include <utility>

#include "core/sdk/block.hpp"

namespace signorini {

template <int B>
DirectNewtonSystem<B>::DirectNewtonSystem(const BlockMatrix<B>& A, const FollowingLoad<B>* load,
                                          std::unique_ptr<UnsymmetricSolver> linear)
    : A_(A), linear_(std::move(linear)), place_(A.column.size()) {
  if (load) load_ = load->matrices();
  transpose();
  std::vector<Offset> start{0};
  std::vector<Index> column;
  for (Index p = 0; p < A.size(); ++p) add_vector(p, start, column);
  for (Index k = 0; k + 1 < std::ssize(load_.row); ++k) add_load(k, start, column);
  linear_->analyse(start, column);
}

template <int B>
void DirectNewtonSystem<B>::transpose() {
  first_.assign(static_cast<std::size_t>(A_.size()) + 1, 0);
  for (const Index p : load_.column) ++first_[p + 1];
  for (Index p = 0; p < A_.size(); ++p) first_[p + 1] += first_[p];
  entries_.resize(load_.column.size());
  std::vector<Offset> next(first_.begin(), first_.end() - 1);
  for (Index k = 0; k + 1 < std::ssize(load_.row); ++k)
    for (Offset at = load_.row[k]; at < load_.row[k + 1]; ++at) entries_[next[load_.column[at]]++] = {k, at};
}

// With ascending columns: there the diagonal block is not the first one, as it is in A.
template <int B>
void DirectNewtonSystem<B>::add_vector(Index p, std::vector<Offset>& start, std::vector<Index>& column) {
  const Offset first = A_.row[p], count = A_.row[p + 1] - first;
  const auto others = A_.column.begin() + first + 1;
  const Offset before = std::lower_bound(others, others + (count - 1), p) - others;
  begin_.push_back(start.back());
  for (Offset m = 0; m < count; ++m) {
    const Offset at = m == 0 ? before : m <= before ? m - 1 : m;
    place_[first + m] = start.back() + at * B;
  }
  for (int i = 0; i < B; ++i) {
    for (Offset at = 0; at < count; ++at) {
      const Index q = at == before ? p : A_.column[first + (at < before ? at + 1 : at)];
      for (int j = 0; j < B; ++j) column.push_back(q * B + j);
    }
    for (Offset e = first_[p]; e < first_[p + 1]; ++e) column.push_back(A_.size() * B + entries_[e].row);
    start.push_back(std::ssize(column));
  }
  values_.resize(column.size());
}

// No step changes these.
template <int B>
void DirectNewtonSystem<B>::add_load(Index k, std::vector<Offset>& start, std::vector<Index>& column) {
  for (Offset at = load_.row[k]; at < load_.row[k + 1]; ++at)
    for (int i = 0; i < B; ++i) {
      column.push_back(load_.column[at] * B + i);
      values_.push_back(load_.value[at * B + i]);
    }
  for (Offset at = load_.mass_row[k]; at < load_.mass_row[k + 1]; ++at) {
    column.push_back(A_.size() * B + load_.mass_column[at]);
    values_.push_back(-load_.mass[at]);
  }
  start.push_back(std::ssize(column));
}

template <int B>
void DirectNewtonSystem<B>::set_row(Index p, const double* by_force, const double* by_value) {
  const Offset blocks = A_.row[p + 1] - A_.row[p], stride = blocks * B + first_[p + 1] - first_[p];
  for (Offset m = A_.row[p]; m < A_.row[p + 1]; ++m) {
    double block[B * B];
    block::multiply<B>(by_force, A_.at(m), block);
    if (m == A_.row[p])
      for (int i = 0; i < B * B; ++i) block[i] += by_value[i];
    for (int i = 0; i < B; ++i) std::copy_n(block + i * B, B, values_.data() + place_[m] + i * stride);
  }
  double* value = values_.data() + begin_[p] + blocks * B;
  for (Offset e = first_[p]; e < first_[p + 1]; ++e, ++value) {
    double pressed[B];
    block::product<B>(by_force, load_.value.data() + entries_[e].at * B, pressed);
    for (int i = 0; i < B; ++i) value[i * stride] = pressed[i];
  }
}

template <int B>
bool DirectNewtonSystem<B>::factorise() {
  ++factorisations_;
  return linear_->factorise(values_);
}

template <int B>
bool DirectNewtonSystem<B>::solve(std::vector<double>& b) {
  ++solves_;
  linear_->solve(b);
  return true;
}

template class DirectNewtonSystem<1>;
template class DirectNewtonSystem<2>;
template class DirectNewtonSystem<3>;

}  // namespace signorini
