#pragma once
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Takes out the weights that carry corrections to constrained vectors from coarse ones whose twins are not
/// constrained; those left in a row are scaled to keep its sum. Coarse vectors without twin count as constrained. What
/// is left needs bounds on coarse twins of constrained vectors only (Krause 4.6); a constrained vector without such a
/// neighbour gets no correction.
/// @param slot per fine vector, -1: not constrained; empty: none is
void reach_from_twins(const std::vector<Index>& slot, Prolongation& prolongation);

}  // namespace signorini
