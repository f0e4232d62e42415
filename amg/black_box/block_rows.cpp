#include "amg/black_box/block_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"

namespace signorini {
namespace {

constexpr const char* place = "matrix";
// Of an entry, relative to the diagonal entries of its row and column.

[[noreturn]] void fail(const std::string& message) { input_error(place, message); }

void check_shape(const SparseRows& matrix, int block) {
  check_entries(matrix, place);
  if (matrix.rows != matrix.columns)
    fail(fmt::format("found {} rows and {} columns, expected a square matrix", matrix.rows, matrix.columns));
  if (matrix.rows == 0) fail("found no rows, expected at least one");
  if (matrix.rows % block != 0)
    fail(fmt::format("found {} rows, expected a multiple of the block size {}", matrix.rows, block));
}

/// One row of blocks at a time, its blocks found by their column.
template <int B>
class RowBuilder {
 public:
  explicit RowBuilder(Index vectors) : position_(static_cast<std::size_t>(vectors), -1) {}

  void append(const SparseRows& matrix, Index p, BlockMatrix<B>& A) {
    if constexpr (B == 1)
      if (ascends(matrix, p)) return append_ascending(matrix, p, A);
    place_of(p);
    for (Index i = 0; i < B; ++i)
      for (Offset k = matrix.row[p * B + i]; k < matrix.row[p * B + i + 1]; ++k) {
        const Index j = matrix.column[k];
        values_[place_of(j / B) + static_cast<std::size_t>(i * B + j % B)] += matrix.value[k];
      }
    std::sort(columns_.begin() + 1, columns_.end());
    for (const Index q : columns_) {
      const double* block = values_.data() + position_[q];
      position_[q] = -1;
      if (q != p && std::all_of(block, block + B * B, [](double v) { return v == 0; })) continue;
      A.column.push_back(q);
      A.value.insert(A.value.end(), block, block + B * B);
    }
    A.row.push_back(static_cast<Offset>(A.column.size()));
    columns_.clear();
    values_.clear();
  }

 private:
  static bool ascends(const SparseRows& matrix, Index i) {
    const auto column = matrix.column.begin();
    const auto end = column + matrix.row[i + 1];
    return std::ranges::adjacent_find(column + matrix.row[i], end, std::greater_equal{}) == end;
  }

  // A row without duplicates: nothing is to be added up or sorted.
  static void append_ascending(const SparseRows& matrix, Index p, BlockMatrix<1>& A) {
    const auto diagonal = static_cast<std::size_t>(A.row.back());
    A.column.push_back(p);
    A.value.push_back(0);
    for (Offset k = matrix.row[p]; k < matrix.row[p + 1]; ++k) {
      if (matrix.column[k] == p) {
        A.value[diagonal] = matrix.value[k];
      } else if (matrix.value[k] != 0) {
        A.column.push_back(matrix.column[k]);
        A.value.push_back(matrix.value[k]);
      }
    }
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }

  std::size_t place_of(Index q) {
    if (position_[q] < 0) {
      position_[q] = static_cast<Offset>(values_.size());
      columns_.push_back(q);
      values_.resize(values_.size() + B * B);
    }
    return static_cast<std::size_t>(position_[q]);
  }

  std::vector<Offset> position_;  // among the values of this row; -1: not in it
  std::vector<Index> columns_;    // the diagonal first
  std::vector<double> values_;
};

template <int B>
double diagonal(const BlockMatrix<B>& A, Index i) {
  return A.diagonal(i / B)[i % B * (B + 1)];
}

template <int B>
bool is_zero(const BlockMatrix<B>& A, Index i) {
  for (Offset k = A.row[i / B]; k < A.row[i / B + 1]; ++k) {
    const double* row = A.at(k) + i % B * B;
    if (std::any_of(row, row + B, [](double v) { return v != 0; })) return false;
  }
  return true;
}

template <int B>
std::vector<Flags> hold_zero_rows(BlockMatrix<B>& A) {
  std::vector<Flags> held(static_cast<std::size_t>(A.size()), 0);
  for (Index i = 0; i < A.size() * B; ++i) {
    if (!is_zero(A, i)) continue;
    held[i / B] |= static_cast<Flags>(1u << (i % B));
    A.at(A.row[i / B])[i % B * (B + 1)] = 1;
  }
  return held;
}

template <int B>
void check_diagonal(const BlockMatrix<B>& A) {
  for (Index i = 0; i < A.size() * B; ++i)
    if (const double d = diagonal(A, i); !(d > 0))
      fail(
          fmt::format("the diagonal entry of row {} is {}, expected a positive one: the matrix is not positive "
                      "definite",
                      i + 1, d));
}

/// Compares each block with its counterpart, row by row.
template <int B>
class SymmetryCheck {
 public:
  explicit SymmetryCheck(BlockMatrix<B>& A) : A_(A), next_(A.row.begin(), A.row.end() - 1) {
    for (Index i = 0; i < A.size() * B; ++i) root_.push_back(std::sqrt(diagonal(A, i)));
    for (Offset& k : next_) ++k;
  }

  /// Returns whether a block without counterpart was found, which is rounding, and set to zero.
  bool run() {
    bool lone = false;
    for (Index p = 0; p < A_.size(); ++p) {
      check_blocks(p, p, A_.at(A_.row[p]), A_.at(A_.row[p]));
      for (Offset k = A_.row[p] + 1; k < A_.row[p + 1]; ++k) {
        const Index q = A_.column[k];
        constexpr double zero[B * B] = {};
        const double* counterpart = find(q, p);
        if (!counterpart || q > p) check_blocks(p, q, A_.at(k), counterpart ? counterpart : zero);
        if (counterpart) continue;
        lone = true;
        std::fill_n(A_.at(k), B * B, 0.0);
      }
    }
    return lone;
  }

 private:
  /// The block in row p and column q, null where there is none. For each p, q must ascend.
  const double* find(Index p, Index q) {
    Offset& k = next_[p];
    while (k < A_.row[p + 1] && A_.column[k] < q) ++k;
    return k < A_.row[p + 1] && A_.column[k] == q ? A_.at(k) : nullptr;
  }

  void check_blocks(Index p, Index q, const double* here, const double* there) const {
    for (Index i = 0; i < B; ++i)
      for (Index j = 0; j < B; ++j) check_entry(p * B + i, q * B + j, here[i * B + j], there[j * B + i]);
  }

  void check_entry(Index i, Index j, double here, double there) const {
    constexpr const char* one_triangle =
        "; where one triangle is given, say so (signorini qp: --one-triangle, or 'symmetric' in the first line of the "
        "file; C++: from_triangle(A); C: one_triangle = 1)";
    const double size = root_[i] * root_[j];
    if (std::abs(here - there) > rounding_of_differences * size)
      fail(fmt::format("not symmetric: the entry in row {}, column {} is {}, the one in row {}, column {} is {}{}",
                       i + 1, j + 1, here, j + 1, i + 1, there, here == 0 || there == 0 ? one_triangle : ""));
    if (i != j && std::abs(here) > (1 + rounding_of_differences) * size)
      fail(fmt::format(
          "not positive semidefinite: the entry {} in row {}, column {} is larger than the diagonal entries "
          "{} and {} of these rows allow",
          here, i + 1, j + 1, diagonal(A_, i), diagonal(A_, j)));
  }

  BlockMatrix<B>& A_;
  std::vector<Offset> next_;  // per row: the first entry that no row so far had as counterpart
  std::vector<double> root_;  // of the diagonal
};

template <int B>
BlockMatrix<B> without_zero_blocks(const BlockMatrix<B>& A) {
  BlockMatrix<B> out;
  for (Index p = 0; p < A.size(); ++p) {
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
      const double* block = A.at(k);
      if (A.column[k] != p && std::all_of(block, block + B * B, [](double v) { return v == 0; })) continue;
      out.column.push_back(A.column[k]);
      out.value.insert(out.value.end(), block, block + B * B);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

}  // namespace

template <int B>
BlockMatrix<B> block_matrix(const SparseRows& matrix, std::vector<Flags>* zero_rows) {
  check_shape(matrix, B);
  BlockMatrix<B> A;
  A.row.reserve(static_cast<std::size_t>(matrix.rows / B) + 1);
  A.column.reserve(matrix.column.size() / (B * B));
  A.value.reserve(matrix.column.size());
  RowBuilder<B> builder(matrix.rows / B);
  for (Index p = 0; p < matrix.rows / B; ++p) builder.append(matrix, p, A);
  if (zero_rows) *zero_rows = hold_zero_rows(A);
  check_diagonal(A);
  if (SymmetryCheck<B>(A).run()) A = without_zero_blocks(A);
  return A;
}

template BlockMatrix<1> block_matrix(const SparseRows&, std::vector<Flags>*);
template BlockMatrix<2> block_matrix(const SparseRows&, std::vector<Flags>*);
template BlockMatrix<3> block_matrix(const SparseRows&, std::vector<Flags>*);

}  // namespace signorini
