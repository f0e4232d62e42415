#pragma once
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"

/// Parts of check_scene() and check_dimension(), and what these have in common.
namespace signorini {

/// Whether a body, which exists, has a scalar unknown.
bool scalar(const Scene& scene, const std::string& body);

/// The reader refuses such constants already; a program may have written others. Expressions are checked in use.
void expect_finite(const Field& field, const std::string& place);

/// The keys `pretension` and `lock_at`.
void check_pretension(const Scene& scene, const Scene::Obstacle& obstacle);

/// @param what one of them: "component"
void expect_length(std::size_t found, std::size_t expected, const std::string& place, std::string_view what);

/// Of a condition with a frame or a traction: it has faces.
void expect_faces(const Selection& on, const std::string& place, std::string_view what);

/// The length of Selection::at.
void check_point(const Selection& on, int dimension);

/// The frame of a fix, a load or a spring fits its body, and what it picks.
void check_frame(const Scene::Body& body, Frame frame, const Scene::FrameAxis& axis, const Selection& on,
                 const Scene::Source& source);
template <class Table>
void check_frame(const Scene& scene, const Table& table) {
  const std::optional<Selection> on = table.on;
  check_frame(scene.body(table.body), table.frame, table.axis, on ? *on : Selection{}, table.source);
}

/// The axis of its frame has as many coordinates as space.
void check_axis(const Scene::FrameAxis& axis, int dimension, const Scene::Source& source);
template <class Table>
void check_axis(const Table& table, int dimension) {
  if (table.frame == Frame::cylindrical) check_axis(table.axis, dimension, table.source);
}

/// Each load is given in one way, which fits its body.
void check_loads(const Scene& scene);
void check_load_lengths(const Scene& scene, int dimension);

/// Springs have some stiffness.
void check_springs(const Scene& scene);
void check_spring_lengths(const Scene& scene, int dimension);

}  // namespace signorini
