#include "core/mesh/true_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/mesh/boundary.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/element_map.hpp"

namespace signorini {
namespace {

constexpr double off_surface = 1e-6;  // of a face: vertices so far off are on the surface
constexpr int most_steps = 8;
constexpr double settled = 1e-12;  // of a face
constexpr double grazing = 0.1;    // cosine from which on a line does not meet the surface nearby

template <int D>
std::array<Point<D>, D> face_corners(const Mesh<D>& mesh, Index face) {
  return points_of(mesh.points, mesh.boundary[face].vertices);
}

template <int D>
double size(const std::array<Point<D>, D>& corner) {
  double out = 0;
  for (int i = 1; i < D; ++i) out = std::max(out, length<D>(difference<D>(corner[i], corner[0])));
  return out;
}

template <int D>
Point<D> combined(const std::array<Point<D>, D>& corner, const std::array<double, D>& barycentric) {
  Point<D> out{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) out[k] += barycentric[i] * corner[i][k];
  return out;
}

template <int D>
Point<D> unit(Point<D> v) {
  const double norm = length<D>(v);
  for (double& x : v) x /= norm;
  return v;
}

/// The patch of a face, and where a point of the face is in it.
template <int D>
typename CubicPatch<D>::Derivatives on_patch(const Mesh<D>& mesh, Index face,
                                             const std::array<double, D>& barycentric) {
  const auto corner = in_coarsest_face<D>(face, mesh.refinements);
  std::array<double, D> at{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) at[k] += barycentric[i] * corner[i][k];
  return (*mesh.patches)[face >> ((D - 1) * mesh.refinements)].derivatives(at);
}

/// A plane that touches a patch at a point.
template <int D>
Flat<D> tangent_plane(const typename CubicPatch<D>::Derivatives& at) {
  return {at.value, unit<D>(area_normal(at.first))};
}

}  // namespace

template <int D>
bool stands_for_surface(const Mesh<D>& mesh, Index face) {
  const Index number = mesh.boundary[face].curve;
  if (number < 0) return false;
  const Curve<D>& curve = mesh.curves[number];
  if (curve.kind == CurveKind::elements) return false;
  const auto corner = face_corners(mesh, face);
  const double near = off_surface * size<D>(corner);
  for (int i = 0; i < D; ++i) {
    std::array<double, D> at{};
    at[i] = 1;
    const Point<D> there = curve.is_shape() ? project<D>(curve, corner[i]) : on_patch<D>(mesh, face, at).value;
    if (!(length<D>(difference<D>(there, corner[i])) <= near)) return false;
  }
  return true;
}

template <int D>
SurfacePoint<D> surface_at(const Mesh<D>& mesh, Index face, const std::array<double, D>& barycentric,
                           const Point<D>& direction) {
  const auto corner = face_corners(mesh, face);
  const Point<D> outwards = unit<D>(area_normal(corner)), start = combined<D>(corner, barycentric);
  const Curve<D>& curve = mesh.curves[mesh.boundary[face].curve];
  SurfacePoint<D> out{0, outwards};
  // Along the line to where it meets the plane that touches nearby.
  const auto step = [&](double distance, Point<D> normal) {
    if (dot(normal, outwards) < 0) {
      for (double& x : normal) x = -x;
      distance = -distance;
    }
    const double cosine = dot(normal, direction);
    out.normal = normal;
    const double by = std::abs(cosine) > grazing ? -distance / cosine : 0;
    out.height += by;
    return std::abs(by);
  };
  if (!curve.is_shape()) {
    const Flat<D> plane = tangent_plane<D>(on_patch<D>(mesh, face, barycentric));
    step(dot(difference<D>(start, plane.point), plane.normal), plane.normal);
    return out;
  }
  const double near = settled * size<D>(corner);
  for (int k = 0; k < most_steps; ++k) {
    Point<D> at = start;
    for (int i = 0; i < D; ++i) at[i] += out.height * direction[i];
    const auto off = height<D>(curve, at);
    if (!off || step(off->distance, off->normal) <= near) break;
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(D)                              \
  template bool stands_for_surface<D>(const Mesh<D>&, Index); \
  template SurfacePoint<D> surface_at<D>(const Mesh<D>&, Index, const std::array<double, D>&, const Point<D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
