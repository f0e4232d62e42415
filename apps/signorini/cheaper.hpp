#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/component/registry.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Models that cost less than a scene's, a sentence each: what would say less, and what that would change.
/// - Planes of symmetry through the middle of all bodies that the scene does not use: those that it would be accepted
///   with. Bodies whose meshes come from files are not looked at: these have to be cut beforehand.
/// - Friction whose coefficient is zero.
/// - Of two bodies that touch, one that is so much stiffer that it could as well be rigid.
/// @param file, overrides what the scene was read from
std::vector<std::string> cheaper_models(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                                        const Scene& scene, const Registry& registry);

}  // namespace signorini
