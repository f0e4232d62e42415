#pragma once
#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// A plane where a coordinate has a value.
struct CutPlane {
  int axis;
  double at;
};

/// A ball or an upright circular cylinder, cut by planes: those along x or y go through its centre.
struct RoundShape {
  Curve<3> curve;
  std::vector<CutPlane> planes;

  /// Squared distance to the centre of the ball or to the axis of the cylinder.
  double square(const Point<3>& p) const;
  /// Index into `planes`, or -1.
  int nearest_plane(const Point<3>& p, double within) const;
  /// The plane that all of these points are on, or -1.
  int common_plane(const std::array<Point<3>, 3>& points) const;
  /// Moves a point that is near the surface, or near a rim, exactly onto it.
  Point<3> onto_surface(Point<3> p, bool on_crease) const;
};

/// Ball, half ball and cylinder, or what is left of them at one side of planes through their centre, as one convex
/// domain, whose queries are answered in closed form. Units are the radius.
class RoundDomain : public Domain {
 public:
  explicit RoundDomain(const Ball& ball);
  explicit RoundDomain(const Cylinder& cylinder);

  std::string name() const override { return name_; }
  const OwnUnits<3>& units() const override { return units_; }
  Box box() const override;
  double volume() const override { return volume_; }
  bool inside(const Point<3>& p) const override;
  std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b) const override;
  bool exact() const override { return false; }
  std::vector<Point<3>> surface_points() const override;
  std::vector<Polyline> creases() const override;
  double coarsest_size() const override { return coarsest_size_; }
  /// A sphere of radius r is as far as h^2 / (6 r) from a triangle of edge h <= r.
  double flatness() const override { return 0.25; }
  void finish(Mesh<3>& mesh, const std::vector<bool>& on_crease) const override;

 private:
  std::string name_;
  OwnUnits<3> units_;
  RoundShape given_, own_;  // in the user's coordinates, and in its own
  void halve(const Halved& halved);
  bool halved(std::size_t axis) const { return low_[axis] == 0; }
  void add_rims(std::vector<Polyline>& creases) const;
  void add_arcs_of_sphere(std::vector<Polyline>& creases) const;
  void add_segments(std::vector<Polyline>& creases) const;

  std::vector<std::string> plane_parts_;  // per plane, "" for none
  std::string curved_part_;               // "" if it is all of the boundary
  Point<3> low_{-1, -1, -1}, high_{1, 1, 1};
  double volume_, coarsest_size_;
};

}  // namespace signorini::geometry
