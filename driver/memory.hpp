#pragma once
#include <string>

#include "core/mesh/refine.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// What the bodies of a scene will take when they are solved, beside their meshes, which are there already.
struct PromisedMemory {
  double bytes = 0;
  int bodies = 0;
};

/// Error(Exit::input) at `origin`, naming unknowns and bytes, if a problem on such a hierarchy with `block` unknowns
/// per vertex would not fit into the memory that is available, or needs larger numbers than Index. Else it is promised
/// what it needs beside its meshes.
/// @param promised to the bodies before it; null: there are no others
/// @param quadratic 0, or the dimension where the finest mesh cuts quadratic elements
void check_memory(const HierarchySize& size, int block, const std::string& origin, PromisedMemory* promised = nullptr,
                  int quadratic = 0);

/// The same for a structured mesh before it is built.
template <int D>
void check_memory(const Scene::Block<D>& cells, int block, const std::string& origin);

}  // namespace signorini
