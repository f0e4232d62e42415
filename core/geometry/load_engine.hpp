#pragma once
#include <filesystem>

#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// Loads a geometry library for good. Throws Error(Exit::plugin) naming the path when there is none, or another
/// library.
template <int D>
const Engine<D>& load_engine(const std::filesystem::path& library);

}  // namespace signorini::geometry
