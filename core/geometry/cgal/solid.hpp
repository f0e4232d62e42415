#pragma once
#include "core/geometry/cgal/creases.hpp"

namespace signorini::geometry {

/// The inside of a closed triangle surface, hollow where the surface has components within. Units are the longest edge
/// of its box.
class SolidDomain : public Domain {
 public:
  /// Throws Error(Exit::input) unless the file's surface is closed, free of self-intersections and bounds one piece.
  explicit SolidDomain(const std::string& file);

  std::string name() const override { return surface_.file(); }
  const OwnUnits<3>& units() const override { return surface_.units(); }
  Box box() const override { return surface_.box(); }
  double volume() const override;
  bool inside(const Point<3>& p) const override { return surface_.inside(p); }
  std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b) const override;
  bool exact() const override { return true; }
  std::vector<Point<3>> surface_points() const override;
  std::vector<Polyline> creases() const override { return creases_.lines; }
  std::vector<Point<3>> tips() const override { return creases_.tips; }
  bool flat() const override { return flat_; }
  Index curved_piece(const Point<3>& p) const override { return creases_.curved_piece[surface_.nearest_triangle(p)]; }
  bool may_be_missed() const override { return true; }
  double off_surface(const Point<3>& p) const override;
  double coarsest_size() const override;
  double flatness() const override { return 0.1; }
  void finish(Mesh<3>& mesh, const std::vector<bool>& on_crease) const override;

 private:
  Point<3> given_on_surface(const Point<3>& p) const;
  SurfacePiece piece_of(const Mesh<3>& mesh) const;

  TriangleSurface surface_;
  Creases creases_;
  bool flat_ = true;  // but for creases
};

}  // namespace signorini::geometry
