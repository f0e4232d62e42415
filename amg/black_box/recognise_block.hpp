#pragma once
#include "core/algebra/sparse_rows.hpp"

namespace signorini {

/// How many consecutive unknowns of a matrix seem to belong together, such as the displacement of a mesh vertex: 2 or 3
/// where most rows of such blocks are coupled to about the same blocks, rows of different blocks mostly are not
/// (all rows of a dense matrix are), and couplings of different components are no small part of all; else 1, as for
/// fewer than four blocks and for blocks that nothing couples.
/// @param matrix with both triangles; whatever is wrong with it, the answer is 1 then
int recognised_block(const SparseRows& matrix);

}  // namespace signorini
