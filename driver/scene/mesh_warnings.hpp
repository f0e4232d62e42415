#pragma once
#include <string>
#include <vector>

#include "core/io/mesh_file.hpp"
#include "core/io/warning.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// What is odd about the mesh of a file, one sentence each with the first such place, beginning with `place`: groups of
/// faces off the boundary; elements that hang together by vertices or edges only; vertices inside faces of others.
template <int D>
Warnings mesh_warnings(const Mesh<D>& mesh, const FileGroups& groups, const std::string& place);

/// Error(Exit::input) at the selection of the scene that names a group of elements, or one without boundary faces.
template <int D>
void refuse_lost_groups(const Scene& scene, const Scene::Body& body, const Mesh<D>& mesh, const FileGroups& groups);

}  // namespace signorini
