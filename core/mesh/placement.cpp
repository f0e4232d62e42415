#include "core/mesh/placement.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

template <int D>
Flat<D> flat_of(const Mirror& mirror) {
  Flat<D> out{};
  out.point[mirror.axis] = mirror.at;
  out.normal[mirror.axis] = 1;
  return out;
}

}  // namespace

template <int D>
void Placement<D>::add(Index f) {
  const Face<D>& face = mesh_.boundary[f];
  const Curve<D>* curve = face.curve < 0 ? nullptr : &mesh_.curves[face.curve];
  if (!curve)
    planes_.push_back(plane_of(face));
  else if (curve->is_shape() && std::ranges::count(shapes_, curve) == 0)
    shapes_.push_back(curve);
  else if (curve->kind == CurveKind::patches)
    patch_ = f;
}

template <int D>
Point<D> Placement<D>::on_shapes(const Point<D>& middle, double reach) const {
  std::vector<Flat<D>> planes = planes_;
  for (const Mirror& mirror : mesh_.mirrors)
    if (lies_on<D>(mirror, middle)) planes.push_back(flat_of<D>(mirror));
  const Point<D> alone = project<D>(*shapes_[0], middle);
  if (shapes_.size() + planes.size() == 1) return alone;
  if (shapes_.size() == 1 &&
      std::abs(dot(difference<D>(alone, planes[0].point), planes[0].normal)) <= rounding_of_differences * reach)
    return alone;
  return project<D>(shapes_, planes, middle, reach);
}

template <int D>
Flat<D> Placement<D>::plane_of(const Face<D>& face) const {
  const auto& p = mesh_.points;
  const Point<D> u = difference<D>(p[face.vertices[1]], p[face.vertices[0]]);
  Flat<D> out{p[face.vertices[0]], {}};
  if constexpr (D == 2)
    out.normal = {u[1], -u[0]};
  else
    out.normal = cross(u, difference<D>(p[face.vertices[2]], p[face.vertices[0]]));
  const double size = length<D>(out.normal);
  for (double& x : out.normal) x /= size;
  return out;
}

template class Placement<2>;
template class Placement<3>;

}  // namespace signorini
