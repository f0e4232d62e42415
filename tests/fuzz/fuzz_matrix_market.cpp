#include <cstdint>

#include "core/base/error.hpp"
#include "core/io/matrix_market.hpp"
#include "core/io/read_file.hpp"

using namespace signorini;

namespace {

SparseRows matrix_of(const std::string& text) {
  try {
    SparseRows matrix = parse_matrix(text, "fuzz");
    check_entries(matrix, "fuzz");
    return matrix;
  } catch (const Error&) {  // the answer to bad input
    return {};
  }
}

}  // namespace

/// Any bytes are a matrix, a vector or an Error, packed or not; what is written of a matrix is read as the same one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  if (is_gzip(text)) text = gunzip(text).value_or("");
  if (text.size() > 1 << 20) return 0;
  try {
    parse_vector(text, "fuzz", 3, Infinities::allowed);
  } catch (const Error&) {
  }
  const SparseRows matrix = matrix_of(text);
  if (static_cast<std::size_t>(matrix.rows) > matrix.value.size()) return 0;  // an array with rows of zeros
  const SparseRows again = parse_matrix(matrix_market(matrix), "fuzz");
  if (again.row != matrix.row || again.column != matrix.column || again.value != matrix.value) __builtin_trap();
  return 0;
}
