#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/check_parts.hpp"

namespace signorini {

void check_frame(const Scene::Body& body, Frame frame, const Scene::FrameAxis& axis, const Selection& on,
                 const Scene::Source& source) {
  const std::string& place = source.of("frame");
  const char* name = frame == Frame::normal ? "normal" : "cylindrical";
  if (frame != Frame::cylindrical)
    for (const char* key : {"center", "axis"})
      if (!(key[0] == 'c' ? axis.center : axis.direction).empty())
        input_error(source.of(key), fmt::format("'{}' has no meaning without frame = 'cylindrical'", key));
  if (frame == Frame::global) return;
  if (body.equation == Scene::Equation::diffusion)
    input_error(place, fmt::format("a scalar unknown has no frame '{}'", name));
  if (frame == Frame::normal) return expect_faces(on, place, "frame 'normal'");
  if (body.plane == Plane::axisymmetric)
    input_error(place,
                "the components of an axisymmetric body are away from its axis and along it already: expected "
                "frame = 'global'");
  if (axis.center.empty()) input_error(place, "a cylindrical frame needs 'center', a point of its axis");
}

void check_axis(const Scene::FrameAxis& axis, int dimension, const Scene::Source& source) {
  expect_length(axis.center.size(), dimension, source.of("center"), "coordinate");
  for (const double x : axis.center) expect_finite(x, source.of("center"));
  if (dimension == 2) {
    if (!axis.direction.empty())
      input_error(source.of("axis"), "the axis of a frame in the plane is across it: expected no 'axis'");
    return;
  }
  if (axis.direction.empty())
    input_error(source.of("frame"), "a cylindrical frame in space needs 'axis', the direction of its axis");
  expect_length(axis.direction.size(), dimension, source.of("axis"), "coordinate");
  for (const double x : axis.direction) expect_finite(x, source.of("axis"));
  if (std::ranges::all_of(axis.direction, [](double x) { return x == 0; }))
    input_error(source.of("axis"), "this vector is zero, expected a direction");
}

}  // namespace signorini
