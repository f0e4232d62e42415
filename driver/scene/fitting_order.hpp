#pragma once
#include <string>
#include <vector>

#include "core/io/warning.hpp"
#include "core/scene/scene.hpp"
#include "driver/scene/memory.hpp"

namespace signorini {

/// Takes linear elements for a body where the scene leaves the choice, with a warning that says why. False where it
/// does not, or they are linear already.
bool take_linear_elements(Scene& scene, std::size_t body, const TooLarge& why, Warnings& warnings);

/// What build() returns, which builds the meshes of a body. Where it is quadratic elements that do not fit into the
/// memory, and the scene leaves the choice, it is called again for linear ones.
/// @param scene of with_touching_bodies()
/// @param warnings that build() adds to
template <class Build>
decltype(auto) with_fitting_order(Scene& scene, std::size_t body, Warnings& warnings, const Build& build) {
  const std::size_t before = warnings.size();
  try {
    return build();
  } catch (const TooLarge& error) {
    warnings.resize(before);
    if (!take_linear_elements(scene, body, error, warnings)) throw;
  }
  return build();
}

/// Bodies whose meshes are kept keep the elements that were chosen for these.
void keep_chosen_orders(const Scene& kept, Scene& scene);

}  // namespace signorini
