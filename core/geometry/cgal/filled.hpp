#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/geometry/cgal/domain.hpp"

namespace signorini::geometry {

/// An edge of a mesh along a crease. Its ends are -1 where no element has them.
struct CreaseEdge {
  std::array<Index, 2> ends;
  Point<3> middle;
  double length;
};

/// What a mesh misses of the domain that it is to fill; nothing where it fills it.
struct Missed {
  /// A place, and how large elements there are.
  struct Place {
    Point<3> at;
    double size;
  };
  std::vector<Place> places;  ///< the worst ones first
  std::string complaint;      ///< "" if there are none
  explicit operator bool() const { return !complaint.empty(); }
};

/// Looks at a mesh, in the domain's coordinates: its surface is to be a manifold, have all creases, and be on the
/// domain's surface, between creases that are flat exactly. Its volume is that of the domain but for what curved faces
/// are off the surface.
/// @param creases all edges that there are to be along the domain's creases
Missed find_missed(const Mesh<3>& mesh, const Domain& domain, const std::vector<CreaseEdge>& creases);

}  // namespace signorini::geometry
