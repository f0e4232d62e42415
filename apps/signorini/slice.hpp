#pragma once
#include <span>
#include <vector>

#include "core/io/picture.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// The section of a tetrahedral mesh with the plane y = `at`, drawn with x to the right and z upwards.
/// @param value one per vertex
std::vector<Patch> slice(const Mesh<3>& mesh, std::span<const double> value, double at);

}  // namespace signorini
