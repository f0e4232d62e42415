#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/cgal/own_units.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

struct Box {
  Point<3> low, high;
};

using Polyline = std::vector<Point<3>>;

/// What the mesher asks of a solid, in coordinates of its own. Points are inside, on the surface or outside; the
/// surface is a closed manifold, smooth but for creases.
class Domain {
 public:
  virtual ~Domain() = default;
  virtual std::string name() const = 0;  ///< for messages
  virtual const OwnUnits<3>& units() const = 0;
  virtual Box box() const = 0;
  virtual double volume() const = 0;
  virtual bool inside(const Point<3>& p) const = 0;
  /// A point of the surface on the segment ab; there is one whenever one end is inside and the other is not.
  virtual std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b) const = 0;
  /// Whether crossing() holds to rounding for any ends. Otherwise it is asked for ends near the box alone, and these
  /// are rounded where dual edges of the mesher reach farther.
  virtual bool exact() const = 0;
  /// A few points spread over the surface.
  virtual std::vector<Point<3>> surface_points() const = 0;
  /// Sharp edges as polylines that meet at most at their ends; a loop repeats its first point.
  virtual std::vector<Polyline> creases() const = 0;
  /// Points off these that the surface is pointed at.
  virtual std::vector<Point<3>> tips() const { return {}; }
  /// Whether the surface is flat between creases.
  virtual bool flat() const { return false; }
  /// The number of the piece of the surface, as creases part it, that is nearest to a point; -1 if it is flat.
  virtual Index curved_piece(const Point<3>&) const { return 0; }
  /// Whether its faces may meet at any angle, so that meshes may miss a part of it.
  virtual bool may_be_missed() const { return false; }
  /// How far a point is from the surface, where that is so.
  virtual double off_surface(const Point<3>&) const { return 0; }
  /// The largest size that still resolves the shape.
  virtual double coarsest_size() const = 0;
  /// How far faces may be from the surface, relative to the size.
  virtual double flatness() const = 0;
  /// Takes the mesh to the user's coordinates, boundary vertices exactly onto the surface there (`on_crease` per vertex
  /// tells those on creases), and names the parts and curves of the boundary faces.
  virtual void finish(Mesh<3>& mesh, const std::vector<bool>& on_crease) const = 0;
};

}  // namespace signorini::geometry
