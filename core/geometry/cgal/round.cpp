#include "core/geometry/cgal/round.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/curve.hpp"

namespace signorini::geometry {

using std::numbers::pi;

namespace {

Curve<3> upright_cylinder(const Point<3>& center, double radius) {
  return {.center = center, .radius = radius, .kind = Curve<3>::Kind::cylinder, .axis = {0, 0, 1}};
}

}  // namespace

RoundDomain::RoundDomain(const Ball& ball)
    : name_(ball.lower_half ? "half_ball" : "ball"),
      units_{ball.center, ball.radius},
      given_{{ball.center, ball.radius}, {}},
      own_{{{}, 1}, {}},
      curved_part_(ball.lower_half ? "curved" : ""),
      volume_((ball.lower_half ? 2 : 4) * pi / 3),
      coarsest_size_(1) {
  if (ball.lower_half) {
    high_[2] = 0;
    given_.planes = {{2, ball.center[2]}};
    own_.planes = {{2, 0}};
    plane_parts_ = {"flat"};
  }
  halve(ball.halved);
}

RoundDomain::RoundDomain(const Cylinder& cylinder)
    : name_("cylinder"),
      units_{cylinder.center, cylinder.radius},
      given_{upright_cylinder(cylinder.center, cylinder.radius),
             {{2, cylinder.center[2] - cylinder.height / 2}, {2, cylinder.center[2] + cylinder.height / 2}}},
      own_{upright_cylinder({}, 1), {}},
      plane_parts_{"bottom", "top"},
      curved_part_("side") {
  const double height = rounded(cylinder.height / cylinder.radius, shape_digits);
  low_[2] = -height / 2;
  high_[2] = height / 2;
  own_.planes = {{2, low_[2]}, {2, high_[2]}};
  volume_ = pi * height;
  coarsest_size_ = std::min(1.0, height);
  if (cylinder.halved[2]) {
    coarsest_size_ = std::min(1.0, height / 2);
    for (auto* list : {&given_.planes, &own_.planes}) list->erase(list->begin());
    plane_parts_.erase(plane_parts_.begin());
  }
  halve(cylinder.halved);
}

void RoundDomain::halve(const Halved& halved) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!halved[axis]) continue;
    low_[axis] = 0;
    volume_ /= 2;
    own_.planes.push_back({axis, 0});
    given_.planes.push_back({axis, given_.curve.center[axis]});
    plane_parts_.emplace_back();
  }
}

Box RoundDomain::box() const { return {low_, high_}; }

double RoundShape::square(const Point<3>& p) const {
  const double x = p[0] - curve.center[0], y = p[1] - curve.center[1], z = p[2] - curve.center[2];
  return x * x + y * y + (curve.kind == Curve<3>::Kind::round ? z * z : 0);
}

bool RoundDomain::inside(const Point<3>& p) const {
  return own_.square(p) < own_.curve.radius * own_.curve.radius && low_[2] < p[2] && p[2] < high_[2] &&
         low_[0] < p[0] && low_[1] < p[1];
}

std::optional<Point<3>> RoundDomain::crossing(const Point<3>& a, const Point<3>& b) const {
  const auto at = [&](double t) {
    return Point<3>{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  };
  // The part first <= t <= last of the line that lies in the quadric ...
  const Point<3> v{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, &c = own_.curve.center;
  const Point<3> m{a[0] - c[0], a[1] - c[1], a[2] - c[2]};
  const double z = own_.curve.kind == Curve<3>::Kind::round ? 1 : 0;
  const double A = v[0] * v[0] + v[1] * v[1] + z * v[2] * v[2], B = m[0] * v[0] + m[1] * v[1] + z * m[2] * v[2];
  const double C = own_.square(a) - own_.curve.radius * own_.curve.radius, discriminant = B * B - A * C;
  double first = -infinity, last = infinity;
  if (A > 0 && discriminant >= 0) {
    const double q = -(B + std::copysign(std::sqrt(discriminant), B));
    const double one = q / A, two = q == 0 ? one : C / q;
    first = std::min(one, two);
    last = std::max(one, two);
  } else if (A > 0 || C > 0) {
    last = first;
  }
  // ... and between the planes.
  for (const std::size_t k : {2, 0, 1}) {
    if (k != 2 && !halved(k)) continue;
    if (v[k] != 0) {
      const double one = (low_[k] - a[k]) / v[k], two = (high_[k] - a[k]) / v[k];
      first = std::max(first, std::min(one, two));
      last = std::min(last, std::max(one, two));
    } else if (a[k] < low_[k] || a[k] > high_[k]) {
      last = -infinity;
    }
  }
  if (first <= last && 0 <= first && first <= 1) return own_.onto_surface(at(first), false);
  if (first <= last && 0 <= last && last <= 1) return own_.onto_surface(at(last), false);
  const bool a_inside = inside(a);
  if (a_inside != inside(b))
    return own_.onto_surface(a_inside ? b : a, false);  // rounding: the outer end is on the surface
  return {};
}

std::vector<Point<3>> RoundDomain::surface_points() const {
  Point<3> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (low_[k] + high_[k]) / 2;
  const double reach = 2 * (1 + high_[2] - low_[2]), golden = (1 + std::sqrt(5)) / 2;
  std::vector<Point<3>> points;
  for (int k = 0; k < 3; ++k)  // towards the vertices of an icosahedron, turned out of the coordinate planes
    for (const double s : {-1.0, 1.0})
      for (const double t : {-golden, golden}) {
        double v[3] = {};
        v[k] = s;
        v[(k + 1) % 3] = t;
        const double c = std::cos(0.3), d = std::sin(0.3);
        const Point<3> outer{middle[0] + reach * (c * v[0] - d * v[1]), middle[1] + reach * (d * v[0] + c * v[1]),
                             middle[2] + reach * v[2]};
        if (const auto p = crossing(middle, outer)) points.push_back(*p);
      }
  return points;
}

std::vector<Polyline> RoundDomain::creases() const {
  std::vector<Polyline> all;
  add_rims(all);
  if (own_.curve.kind == Curve<3>::Kind::round) add_arcs_of_sphere(all);
  add_segments(all);
  return all;
}

namespace {

constexpr int circle_points = 4096;  // within 3e-7 radii of the circle; vertices are moved onto it in the end

/// A part of the circle around `axis` at a height: points first to last of its `circle_points`.
Polyline arc_of_circle(std::size_t axis, double height, int first, int last) {
  Polyline arc;
  for (int i = first; i <= last; ++i) {
    const double angle = 2 * pi * (i % circle_points) / circle_points;
    Point<3>& p = arc.emplace_back();
    p[axis] = height;
    p[(axis + 1) % 3] = std::cos(angle);
    p[(axis + 2) % 3] = std::sin(angle);
  }
  return arc;
}

/// Likewise its quarters at the sides of the larger coordinates where these are halved.
template <class Halved>
void add_quarters(std::size_t axis, double height, const Halved& halved, std::vector<Polyline>& creases) {
  constexpr int quarter = circle_points / 4;
  const bool right = halved((axis + 1) % 3), upper = halved((axis + 2) % 3);
  for (int k = 0; k < 4; ++k) {
    if ((right && (k == 1 || k == 2)) || (upper && k >= 2)) continue;
    Polyline arc = arc_of_circle(axis, height, k * quarter, (k + 1) * quarter);
    for (Point<3>* end : {&arc.front(), &arc.back()})  // where creases meet they have the same point
      for (const std::size_t i : {(axis + 1) % 3, (axis + 2) % 3}) (*end)[i] = std::round((*end)[i]);
    creases.push_back(std::move(arc));
  }
}

}  // namespace

/// The circles around z. The mesher searches polylines segment by segment, hence those of flat cylinders come in arcs.
void RoundDomain::add_rims(std::vector<Polyline>& creases) const {
  const double edges = 2 * pi / coarsest_size_;
  const int arcs = static_cast<int>(std::clamp(edges / 64, 1.0, 64.0));
  for (const CutPlane& plane : own_.planes) {
    if (plane.axis != 2) continue;
    if (halved(0) || halved(1)) {
      add_quarters(
          2, plane.at, [this](std::size_t k) { return halved(k); }, creases);
      continue;
    }
    for (int arc = 0; arc < arcs; ++arc)
      creases.push_back(arc_of_circle(2, plane.at, arc * circle_points / arcs, (arc + 1) * circle_points / arcs));
  }
}

void RoundDomain::add_arcs_of_sphere(std::vector<Polyline>& creases) const {
  const std::size_t first = creases.size();
  for (const std::size_t axis : {0, 1})
    if (halved(axis))
      add_quarters(
          axis, 0, [this](std::size_t k) { return halved(k); }, creases);
  if (high_[2] != 0) return;
  const auto above = [](const Polyline& arc) { return arc[arc.size() / 2][2] > 0; };
  creases.erase(std::remove_if(creases.begin() + static_cast<Offset>(first), creases.end(), above), creases.end());
}

/// Where planes meet, and where those through the axis of a cylinder meet it.
void RoundDomain::add_segments(std::vector<Polyline>& creases) const {
  const auto add = [&](Point<3> from, Point<3> to) { creases.push_back({from, to}); };
  if (halved(0) && halved(1)) add({0, 0, low_[2]}, {0, 0, high_[2]});
  for (const CutPlane& plane : own_.planes)
    if (plane.axis == 2) {
      if (halved(0)) add({0, low_[1], plane.at}, {0, 1, plane.at});
      if (halved(1)) add({low_[0], 0, plane.at}, {1, 0, plane.at});
    }
  if (own_.curve.kind == Curve<3>::Kind::round) return;
  for (const double side : {-1.0, 1.0}) {
    if (halved(0) && side >= low_[1]) add({0, side, low_[2]}, {0, side, high_[2]});
    if (halved(1) && side >= low_[0]) add({side, 0, low_[2]}, {side, 0, high_[2]});
  }
}

int RoundShape::nearest_plane(const Point<3>& p, double within) const {
  int nearest = -1;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (const double d = std::abs(p[planes[k].axis] - planes[k].at); d <= within) {
      nearest = static_cast<int>(k);
      within = d;
    }
  return nearest;
}

int RoundShape::common_plane(const std::array<Point<3>, 3>& points) const {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (std::ranges::all_of(points, [&](const Point<3>& p) { return p[planes[k].axis] == planes[k].at; }))
      return static_cast<int>(k);
  return -1;
}

Point<3> RoundShape::onto_surface(Point<3> p, bool on_crease) const {
  // The mesher's points are on the surface up to rounding, those on creases up to the polyline's distance.
  constexpr double near = 1e-5;  // of the radius, on creases
  const double to_curve = std::abs(std::sqrt(square(p)) - curve.radius);
  if (!on_crease) {
    const int plane = nearest_plane(p, to_curve);
    if (plane < 0) return project<3>(curve, p);
    p[planes[plane].axis] = planes[plane].at;
    return p;
  }
  bool upright = false;  // at a height that stays
  for (const CutPlane& plane : planes) {
    if (std::abs(p[plane.axis] - plane.at) > near * curve.radius) continue;
    p[plane.axis] = plane.at;
    upright = upright || plane.axis == 2;
  }
  if (to_curve > near * curve.radius) return p;
  const double height = p[2];
  p = project<3>(upright ? upright_cylinder(curve.center, curve.radius) : curve, p);
  if (upright) p[2] = height;
  return p;
}

void RoundDomain::finish(Mesh<3>& mesh, const std::vector<bool>& on_crease) const {
  mesh.curves = {given_.curve};
  std::vector<Part> parts;
  for (const std::string& part : plane_parts_) parts.push_back({part, {}});
  parts.push_back({curved_part_, {}});
  for (Point<3>& p : mesh.points) p = units_.given(p);
  std::vector<bool> done(mesh.points.size(), false);
  for (Face<3>& face : mesh.boundary)
    for (const Index v : face.vertices)
      if (!done[v]) {
        mesh.points[v] = given_.onto_surface(mesh.points[v], on_crease[v]);
        done[v] = true;
      }
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    Face<3>& face = mesh.boundary[f];
    const auto& [a, b, c] = face.vertices;
    const int plane = given_.common_plane({mesh.points[a], mesh.points[b], mesh.points[c]});
    if (plane < 0) face.curve = 0;
    parts[plane < 0 ? plane_parts_.size() : static_cast<std::size_t>(plane)].faces.push_back(static_cast<Index>(f));
  }
  for (Part& part : parts)
    if (!part.name.empty()) mesh.parts.push_back(std::move(part));
}

}  // namespace signorini::geometry
