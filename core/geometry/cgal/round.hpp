#pragma once
#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// A ball or an upright circular cylinder, cut by horizontal planes: ball, half ball and cylinder are one convex
/// domain, whose queries are answered in closed form.
class RoundDomain : public Domain {
 public:
  explicit RoundDomain(const Ball& ball);
  explicit RoundDomain(const Cylinder& cylinder);

  std::string name() const override { return name_; }
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
  struct Plane {
    double z;
    std::string part;
  };
  // Squared distance to the centre of the ball or to the axis of the cylinder.
  double square(const Point<3>& p) const;
  Point<3> onto_surface(Point<3> p, bool on_crease) const;
  int nearest_plane(const Point<3>& p, double within) const;  // index into planes_, or -1

  std::string name_;
  Curve<3> curve_;
  std::string curved_part_;  // "" if it is all of the boundary
  std::vector<Plane> planes_;
  double low_, high_;  // range of z
  double volume_, coarsest_size_;
};

}  // namespace signorini::geometry
