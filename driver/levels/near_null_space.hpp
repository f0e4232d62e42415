#pragma once
#include "core/algebra/near_null_space.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {

/// The rigid motions of elastic bodies, in terms of their unknowns; of a scalar one nothing.
/// @param jumps null: all unknowns are displacements
template <int D, int B>
NearNullSpace near_null_space(const Nodes<D>& nodes, const Jumps<B>* jumps);

}  // namespace signorini
