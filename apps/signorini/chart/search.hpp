#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace signorini::chart {

/// What has a wanted accuracy.
struct Found {
  std::vector<std::string> keys;  ///< as after --set
  double error;                   ///< about that of what was found, relative
};

/// Solves a scene with linear and then with quadratic elements on finer and finer meshes, until what is left of the
/// error of a quantity (see quantity()) is small enough by the differences of its values. All solves but the last one
/// together take less time than that: a third of it in the plane.
/// @param say is told of each solve
Found search(const std::filesystem::path& scene, const std::vector<std::string>& overrides, const std::string& of,
             double accuracy, const std::function<void(const std::string&)>& say);

/// Error(Exit::usage) where reports of a scene have no such quantity.
void check_quantity(const Scene& scene, const std::string& of);

}  // namespace signorini::chart
