#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Interpolation from a coarse to a fine level: scalar weights in compressed rows, one row per fine vector, the same
/// for all components. A coarse vector whose row holds the single weight one at some fine vector is that vector's twin
/// and shares its frame and its prescribed components. Geometric and algebraic levels use the same form.
struct Prolongation {
  Index coarse = 0;            ///< number of coarse vectors
  std::vector<Offset> row{0};  ///< fine + 1
  std::vector<Index> column;
  std::vector<double> weight;
  bool midpoints = false;  ///< coarse vectors are coupled only where a fine one lies between them (uniform refinement)

  Index fine() const { return static_cast<Index>(row.size()) - 1; }
  /// Whether the fine vector p is the twin of a coarse one.
  bool twin(Index p) const { return row[p + 1] == row[p] + 1 && weight[row[p]] == 1; }
};

}  // namespace signorini
