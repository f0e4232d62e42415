#include "core/component/companion.hpp"
#include "core/geometry/faceted_distance.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/load_engine.hpp"

namespace signorini::geometry {
namespace {

template <int D>
constexpr Companion library_of = D == 2 ? plane_library : geometry_library;

}  // namespace

FacetedDistance::~FacetedDistance() = default;

template <int D>
const Engine<D>& load_engine(const std::filesystem::path& library) {
  void* entry = load_function(library_of<D>, D == 2 ? "signorini_plane_engine" : "signorini_geometry_engine", library);
  return *reinterpret_cast<const Engine<D>* (*)()>(entry)();
}

template <int D>
const Engine<D>& engine() {
  static const Engine<D>& loaded = load_engine<D>(path_of(library_of<D>));
  return loaded;
}

template const Engine<2>& load_engine<2>(const std::filesystem::path&);
template const Engine<3>& load_engine<3>(const std::filesystem::path&);
template const Engine<2>& engine<2>();
template const Engine<3>& engine<3>();

}  // namespace signorini::geometry
