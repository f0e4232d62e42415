#pragma once
#include <numbers>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Flat faces that meet at more (radians) meet at an edge: the angle that bodies have their creases by.
inline constexpr double largest_turn = 35 * std::numbers::pi / 180;

/// How far flat faces with this angle (radians) between them are from the curve through their vertices that they may
/// stand for; 0 where the angle is so large, more than largest_turn, that there is an edge, or nothing but rounding.
/// @param across extent of the smaller face across what both have in common
double sagitta(double angle, double across);

/// Where a smooth surface has taken the place of flat faces that meet at an angle.
struct SmoothedOver {
  double by = 0;     ///< how far it is off them
  double angle = 0;  ///< in radians
  /// About how far it may be off the true surface, if that is smooth: by the fourth power of the size of faces.
  double error() const { return by * angle * angle; }
};

struct Chords {
  double sagitta = 0;       ///< the largest one
  double angle = 0;         ///< between the faces there, in radians
  SmoothedOver smoothed{};  ///< the one with the largest error, of faces on patches
};

/// The largest sagitta of the coarsest mesh where vertices are marked: between faces that have a marked edge (2D: a
/// vertex) in common and are not on a curve that the mesh knows, unless both are of flat parts of several rows: an edge
/// is meant there, as it is where the nodes of a second-order file say so (Face::straight). Faces at more than
/// largest_turn and up to 60 degrees count where they look like a round: five and more directions, one angle between
/// them.
/// @param marked vertices of the finest mesh; on coarser ones those are that they were made from
template <int D>
Chords chord_sagitta(const MeshHierarchy<D>& hierarchy, std::vector<bool> marked);

}  // namespace signorini
