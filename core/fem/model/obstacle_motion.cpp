#include "core/fem/model/obstacle_motion.hpp"

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"

namespace signorini {
namespace {

using Vector = std::array<double, 3>;

/// v turned as the unit vector a is turned to b, the shortest way (Rodrigues); opposite ones stay.
Vector turned(const Vector& v, const Vector& a, const Vector& b) {
  const double cosine = dot(a, b);
  if (!(1 + cosine > rounding_of_differences)) return v;
  const Vector axis = cross(a, b), across = cross(axis, v);
  const double along = dot(axis, v) / (1 + cosine);
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = cosine * v[i] + across[i] + along * axis[i];
  return out;
}

}  // namespace

template <int B>
std::array<double, B> obstacle_motion(const ObstacleTerm<B>& term, const SurfaceVertex& vertex, Status& status) {
  std::array<double, B> out{};
  if (!term.shape || !term.shape_before) return out;
  Placement before, now;
  term.shape_before->place(vertex.position, vertex.normal, before, status);
  term.shape->place(vertex.position, vertex.normal, now, status);
  if (!status.ok()) return out;
  Vector arm, from, to;
  for (std::size_t i = 0; i < 3; ++i) {
    arm[i] = vertex.position[i] - before.origin[i];
    from[i] = before.axis[i];
    to[i] = now.axis[i];
  }
  const Vector to_arm = from == to ? arm : turned(arm, from, to);
  for (std::size_t i = 0; i < B; ++i) out[i] = (now.origin[i] - before.origin[i]) + (to_arm[i] - arm[i]);
  return out;
}

template std::array<double, 1> obstacle_motion<1>(const ObstacleTerm<1>&, const SurfaceVertex&, Status&);
template std::array<double, 2> obstacle_motion<2>(const ObstacleTerm<2>&, const SurfaceVertex&, Status&);
template std::array<double, 3> obstacle_motion<3>(const ObstacleTerm<3>&, const SurfaceVertex&, Status&);

}  // namespace signorini
