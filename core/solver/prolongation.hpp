#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Interpolation from a coarse to a fine level: weights in compressed rows, one row per fine vector; scalars that are
/// the same for all components, or blocks (see weights.hpp). A coarse vector may be one of the fine vectors, its twin,
/// or stand for its neighbourhood; it shares the twin's frame and prescribed components. Geometric and algebraic levels
/// use the same form.
struct Prolongation {
  Index coarse = 0;            ///< number of coarse vectors
  std::vector<Offset> row{0};  ///< fine + 1
  std::vector<Index> column;
  std::vector<double> weight;  ///< per entry; none where there are blocks
  std::vector<double> block;   ///< B * B per entry, row-major, between global coordinates; for B > 1 only
  bool midpoints = false;  ///< coarse vectors are coupled only where a fine one lies between them (uniform refinement)

  std::vector<Index> twin;  ///< per coarse vector, -1: none; empty where rows with the single scalar weight one tell

  Index fine() const { return static_cast<Index>(row.size()) - 1; }

  /// Per coarse vector its twin, -1: none.
  std::vector<Index> twins() const {
    if (!twin.empty() || coarse == 0) return twin;
    std::vector<Index> out(static_cast<std::size_t>(coarse), -1);
    for (Index p = 0; p < fine(); ++p)
      if (row[p + 1] == row[p] + 1 && weight[row[p]] == 1) out[column[row[p]]] = p;
    return out;
  }
};

}  // namespace signorini
