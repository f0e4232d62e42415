#pragma once
#include <memory>
#include <optional>
#include <string>

#include "core/sdk/settings.hpp"

namespace signorini::geometry {

/// Signed distance to a triangle surface file, see Engine::surface.
std::unique_ptr<DistanceFunction> surface_distance(const std::string& file, std::optional<double> crease);

}  // namespace signorini::geometry
