#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/geometry/cgal/domain.hpp"

namespace signorini::geometry {

/// An oriented manifold triangle surface with fast queries. Edge k of a triangle lies opposite to its vertex k.
/// Queries are thread-safe and deterministic.
class TriangleSurface {
 public:
  /// Where points and queries are: in the surface's own coordinates, see own_units(); or in those of the file less
  /// a point near the surface, so that nothing is lost however far away it is.
  enum class Coordinates { own, centred };

  /// Reads OFF, OBJ, STL or PLY. Equal vertices are merged, duplicate faces dropped, faces of more than three vertices
  /// divided into triangles, and neighbours oriented alike; a closed surface is oriented outwards. Throws
  /// Error(Exit::input) when the file cannot be read or holds no faces.
  TriangleSurface(const std::string& file, Coordinates coordinates);
  ~TriangleSurface();

  const std::string& file() const { return file_; }
  const OwnUnits<3>& units() const { return units_; }
  const std::vector<Point<3>>& points() const { return points_; }
  /// The same in the file's coordinates, exactly.
  const std::vector<Point<3>>& given_points() const { return given_points_; }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  /// Per triangle the neighbour across each edge, -1 at a border.
  const std::vector<std::array<Index, 3>>& neighbours() const { return neighbours_; }
  Box box() const;

  std::size_t border_edges() const;
  bool closed() const { return closed_; }
  /// Per connected component of a closed surface, the number of components around it.
  std::vector<std::size_t> nesting() const;
  /// Two triangles that intersect other than in a common edge or vertex.
  std::optional<std::pair<Index, Index>> self_intersection() const;

  /// For closed surfaces: whether a point is in the volume bounded.
  bool inside(const Point<3>& p) const;
  /// Some point of the surface on the segment ab.
  std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b) const;
  /// A triangle nearest to a point.
  Index nearest_triangle(const Point<3>& p) const;
  /// Calls visit(t) for the triangles that may come within a reach of p, about the nearest first. The reach is what the
  /// last call returned, infinite in the beginning; it must not grow.
  void approach(const Point<3>& p, const std::function<double(Index)>& visit) const;

 private:
  struct Tree;
  std::string file_;
  std::unique_ptr<Tree> tree_;
  OwnUnits<3> units_;
  std::vector<Point<3>> points_, given_points_;
  std::vector<std::array<Index, 3>> triangles_, neighbours_;
  bool closed_ = false;
};

}  // namespace signorini::geometry
