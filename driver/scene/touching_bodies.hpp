#pragma once
#include "core/scene/scene.hpp"

namespace signorini {

/// The scene as it is solved: bodies that obstacles let touch each other, or themselves, are one body, whose `parts`
/// they are, on one mesh; the others stay as they are. All tables keep their numbers and the names that the user gave.
Scene with_touching_bodies(const Scene& scene);

/// The number of a part of such a body's first region on its mesh, see join(); with the number of regions that it has.
std::pair<Index, Index> regions_of_part(const Scene& scene, const Scene::Body& body, std::size_t part);

/// Of a body: those that touch each other have levels by their meshes where others are not asked for.
Scene::Solver solver_options(const Scene& scene, const Scene::Body& body);

/// What an obstacle between bodies calls its first or its other side: the body, and where both are the same the part.
std::string side_of(const Scene::Obstacle& obstacle, bool other);

/// What a table of a body picks, on the mesh that the body is solved on.
Selection on_mesh_of(const Scene::Body& body, const std::string& part, Selection selection);

}  // namespace signorini
