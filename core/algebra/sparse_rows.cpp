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

}  // namespace signorini
