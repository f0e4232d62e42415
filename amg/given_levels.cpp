#include "amg/given_levels.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"

namespace signorini {
namespace {

Prolongation prolongation(const SparseRows& P) {
  Prolongation out;
  out.coarse = P.columns;
  for (Index p = 0; p < P.rows; ++p) {
    std::map<Index, double> weights;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) weights[P.column[k]] += P.value[k];
    for (const auto& [column, weight] : weights)
      if (weight != 0) {
        out.column.push_back(column);
        out.weight.push_back(weight);
      }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

}  // namespace

std::vector<Prolongation> given_levels(std::span<const SparseRows> interpolations, Index vectors) {
  std::vector<Prolongation> out;
  for (std::size_t k = 0; k < interpolations.size(); ++k) {
    const SparseRows& P = interpolations[k];
    const std::string place = fmt::format("interpolation {} of {}, coarsest first", k + 1, interpolations.size());
    check_entries(P, place);
    const bool finest = k + 1 == interpolations.size();
    const Index expected = finest ? vectors : interpolations[k + 1].columns;
    if (P.rows != expected)
      input_error(place, fmt::format("found {} rows, expected {}, the number of {}", P.rows, expected,
                                     finest ? "rows of the matrix over the block size" : "columns of the next one"));
    if (P.columns == 0) input_error(place, "found no columns, expected at least one");
    out.push_back(prolongation(P));
  }
  return out;
}

}  // namespace signorini
