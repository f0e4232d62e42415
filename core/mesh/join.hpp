#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// A part of a body that is one of several in a mesh: "upper/bottom". All faces of the body answer to "upper/boundary"
/// unless it has such a part.
std::string part_of(const std::string& body, const std::string& part);

/// The body that a part of this name is of; empty where it is none of several.
std::string body_of(const std::string& part);

/// Coarsest meshes of several bodies as one, which do not hang together. Parts are named by part_of(). Regions are
/// counted on from one body to the next, each body's own material first: there is a region everywhere. All have the
/// same planes of symmetry.
/// @param materials per body how many it has beside its own
template <int D>
Mesh<D> join(std::vector<Mesh<D>> meshes, const std::vector<std::string>& bodies, const std::vector<int>& materials);

}  // namespace signorini
