#include "core/algebra/sparse_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace signorini {
namespace {

void check_rows(const SparseRows& matrix, std::string_view place) {
  if (matrix.rows < 0 || matrix.columns < 0)
    input_error(place, fmt::format("found {} rows and {} columns, expected sizes that are not negative", matrix.rows,
                                   matrix.columns));
  if (matrix.row.size() != static_cast<std::size_t>(matrix.rows) + 1 || matrix.column.size() != matrix.value.size() ||
      static_cast<Offset>(matrix.value.size()) != std::max<Offset>(matrix.row.back(), 0))
    input_error(place,
                fmt::format("found {} row positions, {} columns and {} values, expected {}, and as many of each "
                            "as the last position says",
                            matrix.row.size(), matrix.column.size(), matrix.value.size(), Offset{matrix.rows} + 1));
  if (matrix.row.front() != 0)
    input_error(place, fmt::format("the first row begins at entry {}, expected 0", matrix.row.front()));
  for (Index i = 0; i < matrix.rows; ++i)
    if (matrix.row[i + 1] < matrix.row[i])
      input_error(place,
                  fmt::format("row {} ends at entry {}, before its begin {}", i + 1, matrix.row[i + 1], matrix.row[i]));
}

void refuse_both_sides(const SparseRows& matrix, std::string_view place) {
  Index above = -1, below = -1;  // the first row with such an entry
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset k = matrix.row[i]; k < matrix.row[i + 1]; ++k)
      if (Index& first = matrix.column[k] > i ? above : below; matrix.column[k] != i && first < 0) first = i;
  if (above >= 0 && below >= 0)
    input_error(place, fmt::format("row {} has an entry above the diagonal and row {} one below, expected one triangle",
                                   above + 1, below + 1));
}

}  // namespace

Index SparseRows::checked_size(Eigen::Index size) {
  constexpr Eigen::Index most = std::numeric_limits<Index>::max();
  if (size > most) input_error("matrix", fmt::format("found {} rows or columns, expected at most {}", size, most));
  return static_cast<Index>(size);
}

void check_entries(const SparseRows& matrix, std::string_view place) {
  check_rows(matrix, place);
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset k = matrix.row[i]; k < matrix.row[i + 1]; ++k) {
      const Index j = matrix.column[k];
      if (j < 0 || j >= matrix.columns)
        input_error(place, fmt::format("row {} has an entry in column {}, expected 1 to {}", i + 1, Offset{j} + 1,
                                       matrix.columns));
      if (!std::isfinite(matrix.value[k]))
        input_error(place, fmt::format("the entry in row {}, column {} is {}, expected a finite number", i + 1, j + 1,
                                       matrix.value[k]));
    }
}

bool is_square(const SparseRows& A) {
  return A.rows > 0 && A.rows == A.columns && std::ssize(A.row) == A.rows + 1 && A.row.front() == 0 &&
         std::ranges::is_sorted(A.row) && A.row.back() == std::ssize(A.column) && A.column.size() == A.value.size() &&
         std::ranges::all_of(A.column, [&](Index c) { return c >= 0 && c < A.columns; });
}

SparseRows from_triangle(const SparseRows& triangle) {
  constexpr const char* place = "triangle of a matrix";
  check_entries(triangle, place);
  if (triangle.rows != triangle.columns)
    input_error(place,
                fmt::format("found {} rows and {} columns, expected as many of each", triangle.rows, triangle.columns));
  refuse_both_sides(triangle, place);
  const auto n = static_cast<std::size_t>(triangle.rows);
  SparseRows out;
  out.rows = out.columns = triangle.rows;
  out.row.assign(n + 1, 0);
  const auto each = [&](const auto& visit) {
    for (Index i = 0; i < triangle.rows; ++i)
      for (Offset k = triangle.row[i]; k < triangle.row[i + 1]; ++k) {
        const Index j = triangle.column[k];
        visit(i, j, triangle.value[k]);
        if (i != j) visit(j, i, triangle.value[k]);
      }
  };
  each([&](Index i, Index, double) { ++out.row[static_cast<std::size_t>(i) + 1]; });
  for (std::size_t i = 0; i < n; ++i) out.row[i + 1] += out.row[i];
  out.column.resize(static_cast<std::size_t>(out.row.back()));
  out.value.resize(out.column.size());
  std::vector<Offset> next(out.row.begin(), out.row.end() - 1);
  each([&](Index i, Index j, double value) {
    out.column[next[i]] = j;
    out.value[next[i]++] = value;
  });
  return out;
}

}  // namespace signorini
