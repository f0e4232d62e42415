#pragma once
#include "core/io/surface_reader.hpp"

namespace signorini::geometry {

/// What a closed surface bounds: the largest of its shells less the others, which are cavities in it, whichever way
/// their faces are oriented. NaN where more than two faces meet at an edge, or one ends there.
double enclosed_volume(const PolygonSoup& surface);

}  // namespace signorini::geometry
