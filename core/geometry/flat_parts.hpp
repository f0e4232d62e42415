#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/geometry/vector.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Flat parts of a surface of flat faces (D = 2: of a curve of edges), as far as digits that a file has rounded away
/// let them be known.
template <int D>
struct FlatParts {
  std::vector<Index> part;       ///< per face its number, or -1
  std::vector<Point<D>> normal;  ///< per part, of unit length
};

/// Faces that continue each other in a plane are a flat part if they are all of a piece, or more than a row of faces: a
/// row, whose vertices are on two lines, may stand for a curve. (D = 2: two or more edges along a line, or a piece.)
/// @param across per face and tip the face and tip beyond, D times its number and the tip; -1 at edges and borders
/// @param curved per face, where that is known: then these are not flat, and all others are
template <int D>
FlatParts<D> find_flat_parts(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                             const std::vector<Index>& across, const std::vector<std::uint8_t>& curved = {});

/// The length by which coordinates may be off, for the file that they come from had no more digits: those of six to
/// nine decimal ones, of single precision, or of double precision. (Round numbers look like few digits; they count as
/// six.)
template <int D>
double rounded_away(std::span<const Point<D>> points);

}  // namespace signorini::geometry
