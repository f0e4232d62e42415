#pragma once
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// What of a motion, or of a direction, a body can follow as a whole: nothing across its planes of symmetry, nor, of a
/// body of revolution, away from the axis. Means over the part that is meshed are those of the whole then.
template <int D>
Point<D> symmetric_motion(const Mesh<D>& mesh, Plane plane, Point<D> motion) {
  for (const Mirror& mirror : mesh.mirrors) motion[mirror.axis] = 0;
  if (plane == Plane::axisymmetric) motion[0] = 0;
  return motion;
}

}  // namespace signorini
