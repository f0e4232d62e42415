#pragma once
#include <string>

#include "core/mesh/refine.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Error(Exit::input) at `origin`, naming unknowns and bytes, if a problem on such a hierarchy with `block` unknowns
/// per vertex would not fit into the memory that is available, or needs larger numbers than Index.
void check_memory(const HierarchySize& size, int block, const std::string& origin);

/// The same for a structured mesh before it is built.
template <int D>
void check_memory(const Scene::Block<D>& cells, int block, const std::string& origin);

}  // namespace signorini
