#pragma once
#include <string>
#include <vector>

#include "core/io/warning.hpp"
#include "core/mesh/mesh.hpp"
#include "core/scene/scene.hpp"
#include "driver/scene/progress.hpp"

namespace signorini {

/// 2 or 3; where only a mesh file tells it, the scene is checked against it.
int dimension_of(const Scene& scene);

/// The coarsest mesh of a body: structured, meshed from its shape, or read from its file. Of one with parts those of
/// all of them.
/// @param block unknowns per vertex, to refuse meshes that would not fit into memory
/// @param warnings where there are any, what is odd about the mesh is added
template <int D>
Mesh<D> coarsest_mesh(const Scene& scene, std::size_t body, int block, Warnings* warnings, const Progress& progress);

}  // namespace signorini
