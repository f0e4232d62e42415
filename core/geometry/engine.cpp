#include "core/component/companion.hpp"
#include "core/geometry/faceted_distance.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/load_engine.hpp"

namespace signorini::geometry {

FacetedDistance::~FacetedDistance() = default;

const Engine& load_engine(const std::filesystem::path& library) {
  void* entry = load_function(geometry_library, "signorini_geometry_engine", library);
  return *reinterpret_cast<const Engine* (*)()>(entry)();
}

const Engine& engine() {
  static const Engine& loaded = load_engine(path_of(geometry_library));
  return loaded;
}

}  // namespace signorini::geometry
