#pragma once
#include <optional>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// The mean motion of the nodes that touch a rigid obstacle, or of the nearest one: where conditions of contact that
/// are linear about the body so displaced are nearer to the true distances than those about ObstacleTerm::moved, and
/// these are noticeably off. Else nothing: on a plane always, and where each node has a way of its own, as on a drum.
/// @param u global coordinates, D per node
template <int D>
std::optional<Point<D>> moved_on(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                 const std::vector<double>& u);

}  // namespace signorini
