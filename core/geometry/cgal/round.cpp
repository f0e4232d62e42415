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
      low_(-1),
      high_(ball.lower_half ? 0 : 1),
      volume_((ball.lower_half ? 2 : 4) * pi / 3),
      coarsest_size_(1) {
  if (!ball.lower_half) return;
  given_.planes = {ball.center[2]};
  own_.planes = {0};
  plane_parts_ = {"flat"};
}

RoundDomain::RoundDomain(const Cylinder& cylinder)
    : name_("cylinder"),
      units_{cylinder.center, cylinder.radius},
      given_{upright_cylinder(cylinder.center, cylinder.radius),
             {cylinder.center[2] - cylinder.height / 2, cylinder.center[2] + cylinder.height / 2}},
      own_{upright_cylinder({}, 1), {}},
      plane_parts_{"bottom", "top"},
      curved_part_("side") {
  const double height = rounded(cylinder.height / cylinder.radius, shape_digits);
  low_ = -height / 2;
  high_ = height / 2;
  own_.planes = {low_, high_};
  volume_ = pi * height;
  coarsest_size_ = std::min(1.0, height);
}

Box RoundDomain::box() const { return {{-1, -1, low_}, {1, 1, high_}}; }

double RoundShape::square(const Point<3>& p) const {
  const double x = p[0] - curve.center[0], y = p[1] - curve.center[1], z = p[2] - curve.center[2];
  return x * x + y * y + (curve.kind == Curve<3>::Kind::round ? z * z : 0);
}

bool RoundDomain::inside(const Point<3>& p) const {
  return own_.square(p) < own_.curve.radius * own_.curve.radius && low_ < p[2] && p[2] < high_;
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
  if (v[2] != 0) {
    const double one = (low_ - a[2]) / v[2], two = (high_ - a[2]) / v[2];
    first = std::max(first, std::min(one, two));
    last = std::min(last, std::max(one, two));
  } else if (a[2] < low_ || a[2] > high_) {
    last = -infinity;
  }
  if (first <= last && 0 <= first && first <= 1) return own_.onto_surface(at(first), false);
  if (first <= last && 0 <= last && last <= 1) return own_.onto_surface(at(last), false);
  const bool a_inside = inside(a);
  if (a_inside != inside(b))
    return own_.onto_surface(a_inside ? b : a, false);  // rounding: the outer end is on the surface
  return {};
}

std::vector<Point<3>> RoundDomain::surface_points() const {
  const Point<3> middle{0, 0, (low_ + high_) / 2};
  const double reach = 2 * (1 + high_ - low_), golden = (1 + std::sqrt(5)) / 2;
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
  constexpr int n = 4096;  // within 3e-7 radii of the circle; vertices are moved onto it in the end
  // The mesher searches polylines segment by segment, hence the rims of flat cylinders come in arcs.
  const double edges = 2 * pi / coarsest_size_;
  const int arcs = static_cast<int>(std::clamp(edges / 64, 1.0, 64.0));
  std::vector<Polyline> rims;
  for (const double z : own_.planes)
    for (int arc = 0; arc < arcs; ++arc) {
      Polyline& rim = rims.emplace_back();
      for (int i = arc * n / arcs; i <= (arc + 1) * n / arcs; ++i)
        rim.push_back({std::cos(2 * pi * (i % n) / n), std::sin(2 * pi * (i % n) / n), z});
    }
  return rims;
}

int RoundShape::nearest_plane(const Point<3>& p, double within) const {
  int nearest = -1;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (const double d = std::abs(p[2] - planes[k]); d <= within) {
      nearest = static_cast<int>(k);
      within = d;
    }
  return nearest;
}

Point<3> RoundShape::onto_surface(Point<3> p, bool on_crease) const {
  // The mesher's points are on the surface up to rounding, those on creases up to the polyline's distance.
  const double to_curve = std::abs(std::sqrt(square(p)) - curve.radius);
  const int plane = nearest_plane(p, on_crease ? infinity : to_curve);
  if (plane >= 0) p[2] = planes[static_cast<std::size_t>(plane)];
  if (plane >= 0 && !on_crease) return p;
  if (plane < 0) return project<3>(curve, p);
  const double height = p[2];
  p = project<3>(upright_cylinder(curve.center, curve.radius), p);
  p[2] = height;
  return p;
}

void RoundDomain::finish(Mesh<3>& mesh, const std::vector<bool>& on_crease) const {
  mesh.curves = {given_.curve};
  for (const std::string& part : plane_parts_) mesh.parts.push_back({part, {}});
  if (!curved_part_.empty()) mesh.parts.push_back({curved_part_, {}});
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
    int plane = given_.nearest_plane(mesh.points[face.vertices[0]], 0);
    for (const Index v : face.vertices)
      if (given_.nearest_plane(mesh.points[v], 0) != plane) plane = -1;
    if (plane < 0) face.curve = 0;
    const std::size_t part = plane < 0 ? plane_parts_.size() : static_cast<std::size_t>(plane);
    if (part < mesh.parts.size()) mesh.parts[part].faces.push_back(static_cast<Index>(f));
  }
}

}  // namespace signorini::geometry
