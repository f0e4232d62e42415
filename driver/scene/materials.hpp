#pragma once
#include <vector>

#include "core/io/mesh_file.hpp"
#include "core/scene/scene.hpp"

/// Several materials in one body.
namespace signorini {

/// Per element of a mesh as its file gives it the material of the body's volumes, counted as they stand in the scene,
/// -1 for the body's own; empty without any.
/// @throws Error(Exit::input) at the material whose volume is no group of elements, or shares some with another one
template <int D>
std::vector<Index> regions(const Scene& scene, const Scene::Body& body, const Mesh<D>& mesh, const FileGroups& groups);

/// A coefficient of a body, or of its parts, with that of its materials, told apart by Site::region.
/// @param own where bodies have it
/// @param others where materials have it; null: they have the body's own
Field coefficient(const Scene& scene, const Scene::Body& body, Field Scene::Body::*own,
                  std::optional<Field> Scene::Material::*others = nullptr);

}  // namespace signorini
