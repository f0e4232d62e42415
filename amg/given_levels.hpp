#pragma once
#include <span>
#include <vector>

#include "core/algebra/sparse_rows.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// The interpolations of another linear multigrid code, coarsest first, as levels of ours.
/// Error(Exit::input) naming the interpolation that does not fit to the next finer one, or the last one that does not
/// fit to the number of vectors, and entries that are not finite or in no column.
std::vector<Prolongation> given_levels(std::span<const SparseRows> interpolations, Index vectors);

}  // namespace signorini
