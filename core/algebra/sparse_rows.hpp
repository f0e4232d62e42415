#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// A sparse matrix of scalars in compressed rows, as it comes from files and other codes: the columns of a row in any
/// order, one that stands twice counting as the sum. Sparse matrices of Eigen convert to it.
struct SparseRows {
  Index rows = 0, columns = 0;
  std::vector<Offset> row{0};  ///< rows + 1
  std::vector<Index> column;   ///< from 0
  std::vector<double> value;

  SparseRows() = default;

  /// Copies compressed rows. What is wrong with them check_entries() finds.
  template <std::integral Position>
  SparseRows(Index row_count, Index column_count, const Position* rows_begin, const Index* column_of,
             const double* value_of)
      : rows(row_count), columns(column_count) {
    if (row_count > 0) row.assign(rows_begin, rows_begin + row_count + 1);
    const Offset entries = std::max<Offset>(row.back(), 0);
    column.assign(column_of, column_of + entries);
    value.assign(value_of, value_of + entries);
  }

  /// A copy of what is a sparse matrix for Eigen: one of its own, a Map, an expression.
  template <class Matrix>
  SparseRows(const Eigen::SparseMatrixBase<Matrix>& matrix)  // NOLINT: a conversion is what it is for
      : rows(checked_size(matrix.rows())), columns(checked_size(matrix.cols())) {
    static_assert(std::is_same_v<typename Matrix::Scalar, double>, "doubles, see cast<double>()");
    Eigen::SparseMatrix<double, Eigen::RowMajor, typename Matrix::StorageIndex> ordered = matrix;
    ordered.makeCompressed();
    row.assign(ordered.outerIndexPtr(), ordered.outerIndexPtr() + rows + 1);
    column.assign(ordered.innerIndexPtr(), ordered.innerIndexPtr() + ordered.nonZeros());
    value.assign(ordered.valuePtr(), ordered.valuePtr() + ordered.nonZeros());
  }

 private:
  /// Error(Exit::input) where an Index does not hold it.
  static Index checked_size(Eigen::Index size);
};

/// Error(Exit::input) naming `place` where rows do not follow each other, a column does not exist or a value is not
/// finite. Rows and columns are counted from 1 in messages.
void check_entries(const SparseRows& matrix, std::string_view place);

/// Whether there are rows, as many as columns, that follow each other and whose columns exist.
bool is_square(const SparseRows& matrix);

/// The symmetric matrix that one of its triangles, the lower or the upper one with the diagonal, stands for.
/// Error(Exit::input) for a matrix as above, and where entries lie on both sides of the diagonal.
SparseRows from_triangle(const SparseRows& triangle);

}  // namespace signorini
