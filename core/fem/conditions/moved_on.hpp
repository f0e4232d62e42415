#pragma once
#include <optional>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// The mean motion of the nodes that touch a rigid obstacle, or of the nearest one: where the condition of contact
/// about the body so displaced is noticeably another one than about ObstacleTerm::moved. Else nothing: on a plane
/// always.
/// @param u global coordinates, D per node
template <int D>
std::optional<Point<D>> moved_on(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                 const std::vector<double>& u);

}  // namespace signorini
