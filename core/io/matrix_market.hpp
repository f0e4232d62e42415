#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/algebra/sparse_rows.hpp"

/// Matrix Market files: coordinate and array, real and integer, general and symmetric; packed by gzip or not. Whatever
/// the format does not allow, entries that stand twice included, is an Error(Exit::input) naming the file and the line.
namespace signorini {

/// A matrix with an entry in every row at least. Of a symmetric one both triangles are returned.
SparseRows read_matrix(const std::filesystem::path& path);

/// Which values a vector may hold besides finite ones.
enum class Infinities { refused, allowed };

/// One column of `size` rows; what a coordinate file leaves out is zero.
std::vector<double> read_vector(const std::filesystem::path& path, Index size, Infinities infinities);

/// A dense matrix, row by row.
struct Columns {
  Index columns = 0;
  std::vector<double> value;
};

/// Finite values in `size` rows and from `fewest` to `most` columns.
Columns read_columns(const std::filesystem::path& path, Index size, Index fewest, Index most);

/// The same from memory, unpacked; `place` is the name used in messages.
SparseRows parse_matrix(std::string_view text, std::string_view place);
std::vector<double> parse_vector(std::string_view text, std::string_view place, Index size, Infinities infinities);
Columns parse_columns(std::string_view text, std::string_view place, Index size, Index fewest, Index most);

/// A file's text, in full precision: one column as an array, a matrix in coordinates.
std::string matrix_market(std::span<const double> vector);
std::string matrix_market(const SparseRows& matrix);

}  // namespace signorini
