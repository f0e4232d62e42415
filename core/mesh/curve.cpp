#include "core/mesh/curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double least_volume = 0.1;  // of the element before the move
constexpr double least_step = 1.0 / 16;

struct Touched {
  Index element;
  double volume;  // before the move
};

}  // namespace

namespace {

template <int D>
Point<D> along(const Point<D>& from, double factor, const Point<D>& direction) {
  Point<D> out;
  for (int k = 0; k < D; ++k) out[k] = from[k] + factor * direction[k];
  return out;
}

/// Of what turns around an axis: the height over the centre, and the direction and length across the axis.
template <int D>
struct Around {
  double along_axis, radius;
  Point<D> out;  // of unit length

  Around(const Curve<D>& curve, const Point<D>& p) {
    const Point<D> from = difference<D>(p, curve.center);
    along_axis = dot(from, curve.axis);
    out = along<D>(from, -along_axis, curve.axis);
    radius = length<D>(out);
    for (double& x : out) x /= radius;
  }
};

}  // namespace

template <int D>
std::optional<Height<D>> height(const Curve<D>& curve, const Point<D>& p) {
  using enum CurveKind;
  if (!curve.is_shape()) return {};
  if (curve.kind == round) {
    Point<D> radial = difference<D>(p, curve.center);
    const double distance = length<D>(radial);
    if (!(distance > 0)) return {};
    for (double& x : radial) x /= distance;
    return Height<D>{distance - curve.radius, radial};
  }
  const Around<D> at(curve, p);
  // A cone's tip is on it, and no direction leads there.
  if (curve.kind == cone && at.radius == 0) return Height<D>{-std::sin(curve.second) * at.along_axis, {}};
  if (!(at.radius > 0)) return {};
  if (curve.kind == cylinder) return Height<D>{at.radius - curve.radius, at.out};
  if (curve.kind == cone) {
    const double c = std::cos(curve.second), s = std::sin(curve.second);
    Point<D> normal = along<D>({}, c, at.out);
    return Height<D>{c * at.radius - s * at.along_axis, along<D>(normal, -s, curve.axis)};
  }
  const double off = at.radius - curve.second, distance = std::hypot(off, at.along_axis);
  if (!(distance > 0)) return {};
  Point<D> normal = along<D>({}, off / distance, at.out);
  return Height<D>{distance - curve.radius, along<D>(normal, at.along_axis / distance, curve.axis)};
}

template <int D>
Point<D> project(const Curve<D>& curve, const Point<D>& p) {
  if (curve.kind == Curve<D>::Kind::round) {
    const Point<D> radial = difference<D>(p, curve.center);
    const double distance = length<D>(radial);
    return distance > 0 ? along<D>(curve.center, curve.radius / distance, radial) : p;
  }
  const auto off = height<D>(curve, p);
  const Point<D> foot = off ? along<D>(p, -off->distance, off->normal) : p;
  const bool beyond_tip = curve.kind == CurveKind::cone && dot(difference<D>(foot, curve.center), curve.axis) < 0;
  return beyond_tip ? curve.center : foot;
}

template <int D>
Point<D> project(std::span<const Curve<D>* const> curves, std::span<const Flat<D>> planes, const Point<D>& p,
                 double reach) {
  constexpr int most = 12;
  constexpr double parallel = 1e-4;
  Point<D> q = p;
  const auto each = [&](const auto& use) {
    for (const Curve<D>* curve : curves)
      if (const auto off = height<D>(*curve, q)) use(*off);
    for (const Flat<D>& plane : planes) use(Height<D>{dot(difference<D>(q, plane.point), plane.normal), plane.normal});
  };
  for (int step = 0; step < most; ++step) {
    // Orthogonal directions: what an earlier surface asks for is kept.
    std::array<Point<D>, D> basis;
    int found = 0;
    Point<D> move{};
    each([&](const Height<D>& off) {
      if (found == D) return;
      Point<D> rest = off.normal;
      for (int k = 0; k < found; ++k) rest = along<D>(rest, -dot(rest, basis[k]), basis[k]);
      const double size = length<D>(rest);
      if (size < parallel) return;
      for (double& x : rest) x /= size;
      move = along<D>(move, -(off.distance + dot(move, off.normal)) / size, rest);
      basis[found++] = rest;
    });
    q = along<D>(q, 1, move);
    if (!(length<D>(difference<D>(q, p)) <= reach)) return p;
    if (length<D>(move) <= 1e-15 * reach) break;
  }
  return q;
}

template <int D>
double least_radius(const Curve<D>& curve, const Point<D>& p) {
  if (curve.kind != Curve<D>::Kind::cone) return curve.radius;
  return Around<D>(curve, p).radius / std::cos(curve.second);
}

template <int D>
std::vector<Index> move_vertices(Mesh<D>& mesh, const std::vector<Move<D>>& moves) {
  if (moves.empty()) return {};
  std::vector<Index> move_of(mesh.points.size(), -1);
  std::vector<Point<D>> start;
  for (std::size_t m = 0; m < moves.size(); ++m) {
    move_of[moves[m].vertex] = static_cast<Index>(m);
    start.push_back(mesh.points[moves[m].vertex]);
  }
  std::vector<Touched> touched;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::ranges::any_of(mesh.elements[e], [&](Index v) { return move_of[v] >= 0; }))
      touched.push_back({static_cast<Index>(e), signed_volume<D>(corners<D>(mesh.points, mesh.elements[e]))});

  std::vector<double> step(moves.size(), 1);
  const auto place = [&](std::size_t m) {
    for (int k = 0; k < D; ++k)
      mesh.points[moves[m].vertex][k] =
          step[m] == 1 ? moves[m].target[k] : start[m][k] + step[m] * (moves[m].target[k] - start[m][k]);
  };
  for (std::size_t m = 0; m < moves.size(); ++m) place(m);

  // Every pass but the last shortens a step, and a step is shortened no more than five times.
  for (bool settled = false; !settled;) {
    settled = true;
    for (const Touched& t : touched) {
      if (signed_volume<D>(corners<D>(mesh.points, mesh.elements[t.element])) > least_volume * t.volume) continue;
      for (const Index v : mesh.elements[t.element])
        if (const Index m = move_of[v]; m >= 0 && step[m] > 0) {
          step[m] = step[m] > least_step ? step[m] / 2 : 0;
          place(m);
          settled = false;
        }
    }
  }
  std::vector<Index> short_of;
  for (std::size_t m = 0; m < moves.size(); ++m)
    if (step[m] < 1) short_of.push_back(moves[m].vertex);
  return short_of;
}

#define SIGNORINI_INSTANTIATE(D)                                                                                     \
  template std::optional<Height<D>> height<D>(const Curve<D>&, const Point<D>&);                                     \
  template Point<D> project<D>(const Curve<D>&, const Point<D>&);                                                    \
  template Point<D> project<D>(std::span<const Curve<D>* const>, std::span<const Flat<D>>, const Point<D>&, double); \
  template double least_radius<D>(const Curve<D>&, const Point<D>&);                                                 \
  template std::vector<Index> move_vertices(Mesh<D>&, const std::vector<Move<D>>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
