#include "core/io/matrix_market.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/error.hpp"
#include "core/io/matrix_market_input.hpp"
#include "core/io/read_file.hpp"

namespace signorini {
namespace {

using Entry = MatrixMarketInput::Entry;

std::string read_text(const std::filesystem::path& path) {
  std::string bytes = read_file(path, "Matrix Market file");
  if (!is_gzip(bytes)) return bytes;
  if (auto text = gunzip(bytes)) return std::move(*text);
  input_error(path.string(), "the gzip data are damaged or cut off");
}

void refuse_infinity(const MatrixMarketInput& input, const Entry& entry) {
  if (!std::isfinite(entry.value)) input.fail(fmt::format("found {}, expected a finite number", entry.value));
}

/// Both triangles of a symmetric matrix.
std::vector<Entry> all_entries(MatrixMarketInput& input) {
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(input.entries()));
  input.for_each_entry([&](const Entry& entry) {
    refuse_infinity(input, entry);
    if (!input.coordinate() && entry.value == 0) return;
    entries.push_back(entry);
    if (input.symmetric() && entry.row != entry.column) entries.push_back({entry.column, entry.row, entry.value});
  });
  return entries;
}

SparseRows compressed(Index rows, Index columns, std::vector<Entry> entries) {
  std::ranges::sort(entries, {}, [](const Entry& entry) { return std::pair(entry.row, entry.column); });
  SparseRows out;
  out.rows = rows;
  out.columns = columns;
  out.row.assign(static_cast<std::size_t>(rows) + 1, 0);
  out.column.reserve(entries.size());
  out.value.reserve(entries.size());
  for (const Entry& entry : entries) {
    ++out.row[entry.row + 1];
    out.column.push_back(entry.column);
    out.value.push_back(entry.value);
  }
  for (Index i = 0; i < rows; ++i) out.row[i + 1] += out.row[i];
  return out;
}

/// Rows may be empty; but a size that the entries are nowhere near is a mistake, and not to be allocated.
void refuse_size_without_entries(const MatrixMarketInput& input) {
  constexpr Offset always_allowed = 1'000'000, most_rows_per_entry = 100;
  if (const Offset entries = input.entries(); input.rows() > std::max(always_allowed, most_rows_per_entry * entries))
    input.fail(fmt::format("found {} rows, but {} entries only, expected one in every {} rows at least", input.rows(),
                           entries, most_rows_per_entry));
}

/// Fails at the line where an entry stands for the second time.
void refuse_second(std::string_view text, std::string_view place, Index row, Index column) {
  MatrixMarketInput input(text, place);
  int seen = 0;
  input.for_each_entry([&](const Entry& entry) {
    if (entry.row == row && entry.column == column && ++seen == 2)
      input.fail(fmt::format("the entry in row {}, column {} stands twice", row + 1, column + 1));
  });
}

void refuse_duplicates(const SparseRows& matrix, std::string_view text, std::string_view place) {
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset k = matrix.row[i] + 1; k < matrix.row[i + 1]; ++k)
      if (const Index j = matrix.column[k]; j == matrix.column[k - 1]) {
        refuse_second(text, place, i, j);
        refuse_second(text, place, j, i);  // the one in the file, of a symmetric matrix
      }
}

/// Row by row; what a coordinate file leaves out is zero.
std::vector<double> dense(MatrixMarketInput& input, Infinities infinities) {
  std::vector<double> out(static_cast<std::size_t>(input.rows()) * input.columns(), 0);
  std::vector<bool> seen(out.size(), false);
  const auto set = [&](Index row, Index column, double value) {
    const auto at = static_cast<std::size_t>(row) * input.columns() + column;
    if (seen[at])
      input.fail(input.columns() == 1
                     ? fmt::format("the entry in row {} stands twice", row + 1)
                     : fmt::format("the entry in row {}, column {} stands twice", row + 1, column + 1));
    seen[at] = true;
    out[at] = value;
  };
  input.for_each_entry([&](const Entry& entry) {
    if (infinities == Infinities::refused) refuse_infinity(input, entry);
    set(entry.row, entry.column, entry.value);
    if (input.symmetric() && entry.row != entry.column) set(entry.column, entry.row, entry.value);
  });
  return out;
}

}  // namespace

SparseRows read_matrix(const std::filesystem::path& path) { return parse_matrix(read_text(path), path.string()); }

std::vector<double> read_vector(const std::filesystem::path& path, Index size, Infinities infinities) {
  return parse_vector(read_text(path), path.string(), size, infinities);
}

Columns read_columns(const std::filesystem::path& path, Index size, Index fewest, Index most) {
  return parse_columns(read_text(path), path.string(), size, fewest, most);
}

SparseRows parse_matrix(std::string_view text, std::string_view place) {
  MatrixMarketInput input(text, place);
  refuse_size_without_entries(input);
  SparseRows matrix = compressed(input.rows(), input.columns(), all_entries(input));
  refuse_duplicates(matrix, text, place);
  return matrix;
}

std::vector<double> parse_vector(std::string_view text, std::string_view place, Index size, Infinities infinities) {
  MatrixMarketInput input(text, place);
  if (input.rows() != size || input.columns() != 1)
    input.fail(fmt::format("found {} rows and {} columns, expected a vector of {} rows and one column", input.rows(),
                           input.columns(), size));
  return dense(input, infinities);
}

Columns parse_columns(std::string_view text, std::string_view place, Index size, Index fewest, Index most) {
  MatrixMarketInput input(text, place);
  if (input.rows() != size || input.columns() < fewest || input.columns() > most)
    input.fail(fmt::format("found {} rows and {} columns, expected {} rows and {} columns", input.rows(),
                           input.columns(), size,
                           fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most)));
  return {input.columns(), dense(input, Infinities::refused)};
}

std::string matrix_market(std::span<const double> vector) {
  std::string text = fmt::format("%%MatrixMarket matrix array real general\n{} 1\n", vector.size());
  for (const double value : vector) fmt::format_to(std::back_inserter(text), "{:.17g}\n", value);
  return text;
}

std::string matrix_market(const SparseRows& matrix) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real general\n{} {} {}\n", matrix.rows,
                                 matrix.columns, matrix.value.size());
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset k = matrix.row[i]; k < matrix.row[i + 1]; ++k)
      fmt::format_to(std::back_inserter(text), "{} {} {:.17g}\n", i + 1, matrix.column[k] + 1, matrix.value[k]);
  return text;
}

}  // namespace signorini
