#pragma once
#include "core/algebra/block_matrix.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// stiffness() for one unknown per node, where to find an entry takes longer than to compute it.
template <int D>
BlockMatrix<1> scalar_stiffness(const Nodes<D>& nodes, const Model<1>& model);

}  // namespace signorini
