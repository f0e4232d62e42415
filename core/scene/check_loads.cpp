#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/check_parts.hpp"

namespace signorini {
namespace {

void check_one_way(const Scene::Load& load) {
  const bool value = !load.value.empty(), pressure = load.pressure.has_value(), total = load.is_total();
  if (!value && !pressure && !total)
    input_error(load.source.table, "none of 'value', 'pressure', 'force' and 'torque' is given, expected one of them");
  const char* total_key = load.force.empty() ? "torque" : "force";
  const auto refuse = [&](const char* first, const char* second) {
    input_error(load.source.of(second), fmt::format("both '{}' and '{}' are given, expected one of them ('force' and "
                                                    "'torque' may stand together)",
                                                    first, second));
  };
  if (value && pressure) refuse("value", "pressure");
  if (value && total) refuse("value", total_key);
  if (pressure && total) refuse("pressure", total_key);
  if (!load.about.empty() && !total)
    input_error(load.source.of("about"), "'about' has no meaning without 'force' or 'torque'");
}

/// What a pressure that acts where contact is open needs.
void check_where_open(const Scene& scene, const Scene::Load& load) {
  if (!load.where_open) {
    if (!load.from.empty()) input_error(load.source.of("from"), "'from' has no meaning without 'where_open'");
    return;
  }
  const std::string& place = load.source.of("where_open");
  if (!load.pressure)
    input_error(place, "'where_open' belongs to 'pressure', which is not given: other loads act whatever is open");
  const auto touches = [&](const Scene::Obstacle& obstacle) {
    return obstacle.body == load.body || obstacle.other == load.body;
  };
  if (std::ranges::none_of(scene.obstacles, touches) && !scene.looks_for_pairs(scene.body(load.body)))
    input_error(place, fmt::format("no obstacle acts on body '{}', so that all of it is open; expected an obstacle, or "
                                   "no 'where_open'",
                                   load.body));
  if (scene.solver.bodies == "dirichlet-neumann")
    input_error(place, "is not available with solver.bodies = 'dirichlet-neumann'; expected 'jumps'");
}

void check_fits_body(const Scene& scene, const Scene::Load& load) {
  const Scene::Body& body = scene.body(load.body);
  const auto forbid = [&](const char* key, bool given, const char* why) {
    if (given) input_error(load.source.of(key), fmt::format("'{}' has no meaning {}", key, why));
  };
  const char* scalar_why = "for equation = 'diffusion'";
  if (body.equation == Scene::Equation::diffusion) {
    forbid("pressure", load.pressure.has_value(), scalar_why);
    forbid("torque", !load.torque.empty(), scalar_why);
    forbid("about", !load.about.empty(), scalar_why);
  }
  const char* axisymmetric = "for an axisymmetric body: nothing of it turns in the half plane of x and y";
  if (body.plane == Plane::axisymmetric) {
    forbid("torque", !load.torque.empty(), axisymmetric);
    forbid("about", !load.about.empty(), axisymmetric);
  }
  if (load.on && !load.is_total()) {
    if (load.pressure) expect_faces(*load.on, load.source.of("pressure"), "a pressure");
  } else if (load.on && (!load.torque.empty() || !load.about.empty())) {
    expect_faces(*load.on, load.source.of(load.torque.empty() ? "about" : "torque"), "a moment");
  }
  if (load.pressure && !load.on)
    input_error(load.source.of("pressure"),
                "a pressure acts on faces: neither 'on' nor 'where' is given, expected one of them");
}

}  // namespace

bool scalar(const Scene& scene, const std::string& body) {
  return scene.body(body).equation == Scene::Equation::diffusion;
}

void expect_finite(const Field& field, const std::string& place) {
  if (const auto value = field.constant(); value && !std::isfinite(*value))
    input_error(place, fmt::format("found {}, expected a finite number", *value));
}

void expect_length(std::size_t found, std::size_t expected, const std::string& place, std::string_view what) {
  if (found != expected)
    input_error(place, fmt::format("expected {} {}{}, found {}", expected, what, expected == 1 ? "" : "s", found));
}

void expect_faces(const Selection& on, const std::string& place, std::string_view what) {
  if (!on.picks_faces())
    input_error(place, fmt::format("{} needs faces, and the table picks {}; expected one part in 'on', or 'where'",
                                   what, on.other ? "an edge" : "a point"));
}

void check_point(const Selection& on, int dimension) {
  if (!on.at.empty()) expect_length(on.at.size(), dimension, on.origin, "coordinate");
  for (const double coordinate : on.at) expect_finite(coordinate, on.origin);
}

void check_loads(const Scene& scene) {
  for (const Scene::Load& load : scene.loads) {
    check_one_way(load);
    check_frame(scene, load);
    if (load.frame != Frame::global && load.value.empty())
      input_error(load.source.of("frame"), "'frame' belongs to 'value': other keys have their own directions");
    if (load.frame == Frame::normal && !load.on)
      input_error(load.source.of("frame"), "frame 'normal' needs faces: neither 'on' nor 'where' is given");
    check_fits_body(scene, load);
    check_where_open(scene, load);
    for (const Field& component : load.value) expect_finite(component, load.source.of("value"));
    for (const Field& component : load.force) expect_finite(component, load.source.of("force"));
    for (const Field& component : load.torque) expect_finite(component, load.source.of("torque"));
    for (const double coordinate : load.about) expect_finite(coordinate, load.source.of("about"));
    if (load.pressure) expect_finite(*load.pressure, load.source.of("pressure"));
  }
}

void check_load_lengths(const Scene& scene, int dimension) {
  for (const Scene::Load& load : scene.loads) {
    const std::size_t components = scalar(scene, load.body) ? 1 : dimension;
    if (load.on) check_point(*load.on, dimension);
    check_axis(load, dimension);
    const auto expect = [&](const auto& list, std::size_t length, const char* key, const char* what) {
      if (!list.empty()) expect_length(list.size(), length, load.source.of(key), what);
    };
    expect(load.value, components, "value", "component");
    expect(load.force, components, "force", "component");
    expect(load.torque, dimension == 3 ? 3 : 1, "torque", "component");
    expect(load.about, dimension, "about", "coordinate");
  }
}

void check_springs(const Scene& scene) {
  for (const Scene::Spring& spring : scene.springs) {
    const std::string& place = spring.source.of(spring.total ? "total" : "stiffness");
    for (const Field& component : spring.stiffness) expect_finite(component, place);
    if (std::ranges::all_of(spring.stiffness, [](const Field& field) { return field.constant() == 0.0; }))
      input_error(place, "the stiffness is zero: nothing is held");
    check_frame(scene, spring);
  }
}

void check_spring_lengths(const Scene& scene, int dimension) {
  for (const Scene::Spring& spring : scene.springs) {
    check_axis(spring, dimension);
    if (spring.stiffness.size() != 1)
      expect_length(spring.stiffness.size(), scalar(scene, spring.body) ? 1 : dimension,
                    spring.source.of(spring.total ? "total" : "stiffness"), "component");
  }
}

}  // namespace signorini
