#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/input/expression.hpp"
#include "core/mesh/mirror.hpp"
#include "core/scene/check_parts.hpp"
#include "core/scene/read_tables.hpp"

namespace signorini {
namespace {

template <class Table>
void check_unique(const std::vector<Table>& tables) {
  for (auto table = tables.begin(); table != tables.end(); ++table) {
    const auto twin = std::find_if(tables.begin(), table, [&](const Table& t) { return t.name == table->name; });
    if (twin != table)
      input_error(table->source.of("name"),
                  fmt::format("the name {} is taken already at {}", in_quotes(table->name), twin->source.of("name")));
  }
}

void refuse_unknown_body(const Scene& scene, const std::string& body, const std::string& place) {
  std::vector<std::string> names;
  for (const Scene::Body& known : scene.bodies) names.push_back(known.name);
  if (std::ranges::find(names, body) != names.end()) return;
  const std::string near = did_you_mean(body, names);
  input_error(place, fmt::format("there is no body {}{}", in_quotes(body),
                                 near.empty() ? fmt::format(" (bodies: {})", fmt::join(names, ", ")) : near));
}

template <class Table>
void check_bodies(const Scene& scene, const std::vector<Table>& tables) {
  for (const Table& table : tables) refuse_unknown_body(scene, table.body, table.source.of("body"));
}

void check_coefficients(const Scene& scene) {
  for (const Scene::Body& body : scene.bodies) {
    expect_finite(body.young, body.source.of("young"));
    expect_finite(body.poisson, body.source.of("poisson"));
    expect_finite(body.diffusion, body.source.of("diffusion"));
    expect_finite(body.expansion, body.source.of("expansion"));
    expect_finite(body.temperature, body.source.of("temperature"));
  }
}

/// A body's temperature acts in all of it: what a part of another material does then is not left to a default.
void check_expansion(const Scene& scene, const Scene::Material& m) {
  const bool wanted = scene.body(m.body).source.given("expansion");
  if (m.expansion && !wanted)
    input_error(m.source.of("expansion"), fmt::format("'expansion' has no meaning where body '{}' has none", m.body));
  if (!m.expansion && wanted)
    input_error(m.source.table, fmt::format("missing key 'expansion', required where body '{}' has it", m.body));
  if (m.expansion) expect_finite(*m.expansion, m.source.of("expansion"));
}

/// Of a direction of any length.
void check_direction(const std::vector<double>& direction, int dimension, const std::string& place) {
  expect_length(direction.size(), static_cast<std::size_t>(dimension), place, "coordinate");
  for (const double x : direction) expect_finite(x, place);
  if (std::ranges::all_of(direction, [](double x) { return x == 0; }))
    input_error(place, "this vector is zero, expected a direction");
}

bool are_parallel(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ab += a[i] * b[i], aa += a[i] * a[i], bb += b[i] * b[i];
  return ab * ab >= (1 - rounding_of_differences) * aa * bb;
}

/// The directions of an orthotropic material.
void check_orthotropic(const Scene::Body& body, int dimension) {
  if (!body.orthotropic) return;
  const auto& [constants, axes, center, axis] = *body.orthotropic;
  const auto place = [&](const char* key) { return body.source.of(key); };
  if (!axes.empty()) {
    expect_length(axes.size(), static_cast<std::size_t>(dimension - 1), place("material_axes"), "direction");
    for (const std::vector<double>& direction : axes) check_direction(direction, dimension, place("material_axes"));
    if (dimension == 3 && are_parallel(axes[0], axes[1]))
      input_error(place("material_axes"), "both directions are the same, expected two");
  }
  if (center.empty()) return;
  expect_length(center.size(), static_cast<std::size_t>(dimension), place("material_center"), "coordinate");
  for (const double x : center) expect_finite(x, place("material_center"));
  if (body.plane == Plane::axisymmetric)
    input_error(place("material_center"),
                "direction 3 of an axisymmetric body is around its axis already: expected no 'material_center'");
  if (dimension == 2 && !axis.empty())
    input_error(place("material_axis"), "the axis is across the plane: expected no 'material_axis'");
  if (dimension == 3 && axis.empty())
    input_error(place("material_center"), "'material_axis' is missing, the direction of the axis");
  if (dimension == 3) check_direction(axis, dimension, place("material_axis"));
}

// What the equation takes, and nothing else.
void check_materials(const Scene& scene) {
  for (const Scene::Material& m : scene.materials) {
    const bool diffusion = scalar(scene, m.body);
    const auto check = [&](const char* key, const std::optional<Field>& value, bool wanted) {
      const bool given = value.has_value();
      const char* equation = diffusion ? "diffusion" : "elasticity";
      if (given && !wanted)
        input_error(m.source.of(key), fmt::format("'{}' has no meaning for equation = '{}'", key, equation));
      if (!given && wanted)
        input_error(m.source.table, fmt::format("missing key '{}', required for equation = '{}'", key, equation));
      if (given) expect_finite(*value, m.source.of(key));
    };
    if (scene.body(m.body).orthotropic)
      input_error(m.source.table,
                  fmt::format("body '{}' is orthotropic, and has one material in this version", m.body));
    check("young", m.young, !diffusion);
    check("poisson", m.poisson, !diffusion);
    check("diffusion", m.diffusion, diffusion);
    check_expansion(scene, m);
    if (!std::holds_alternative<Scene::MeshFile>(scene.body(m.body).shape))
      input_error(
          m.source.of("volume"),
          fmt::format("body '{}' is not read from a mesh file: it has no volumes; expressions in x, y and z may "
                      "tell materials apart",
                      m.body));
  }
}

void check_fixes(const Scene& scene) {
  for (const Scene::Fix& fix : scene.fixes) {
    if (std::none_of(fix.value.begin(), fix.value.end(), [](const auto& component) { return component.has_value(); }))
      input_error(fix.source.of("value"), "every component is free: nothing is fixed");
    check_frame(scene, fix);
    for (const std::optional<Field>& component : fix.value)
      if (component) expect_finite(*component, fix.source.of("value"));
  }
}

/// What a component is prescribed by no force moves.
void refuse_both(const Scene::Rigid& rigid, const std::vector<std::optional<Field>>& prescribed,
                 const std::vector<Field>& force, const char* key, const char* of) {
  for (std::size_t k = 0; k < std::min(prescribed.size(), force.size()); ++k)
    if (prescribed[k] && force[k].constant() != 0.0)
      input_error(rigid.source.of(key), fmt::format("component {} of '{}' is prescribed; expected 0 here, or \"free\" "
                                                    "there",
                                                    k, of));
}

void check_rigids(const Scene& scene) {
  for (const Scene::Rigid& rigid : scene.rigids) {
    if (scalar(scene, rigid.body))
      input_error(rigid.source.of("body"), "a scalar unknown has no rigid motions; expected an elastic body");
    if (!scene.symmetry.planes.empty())
      input_error(rigid.source.table, "rigid parts are not available with [symmetry] in this version");
    refuse_both(rigid, rigid.displacement, rigid.force, "force", "displacement");
    refuse_both(rigid, rigid.rotation, rigid.torque, "torque", "rotation");
    const bool radial =
        !rigid.displacement.empty() && rigid.displacement[0] && rigid.displacement[0]->constant() != 0.0;
    if (scene.body(rigid.body).plane != Plane::axisymmetric) continue;
    for (const char* key : {"rotation", "torque", "point"})
      if (rigid.source.given(key))
        input_error(
            rigid.source.of(key),
            fmt::format("'{}' has no meaning for an axisymmetric body: what is rigid moves along its axis", key));
    if (radial || (!rigid.force.empty() && rigid.force[0].constant() != 0.0))
      input_error(rigid.source.of(radial ? "displacement" : "force"),
                  "what is rigid of an axisymmetric body moves along its axis; expected 0 across it");
  }
}

/// Bodies that touch each other: elastic ones, alike but for mesh and material.
void check_other(const Scene& scene, const Scene::Obstacle& obstacle) {
  if (obstacle.other.empty()) {
    for (const char* key : {"other_on", "other_where", "slave", "pairing", "resolve", "pretension", "lock_at"})
      if (obstacle.source.given(key))
        input_error(obstacle.source.of(key), fmt::format("'{}' has no meaning without 'other', the second body", key));
    if (obstacle.source.given("renew") && !obstacle.shape)
      input_error(obstacle.source.of("renew"),
                  "'renew' has no meaning without 'other', the second body, or 'shape', a rigid obstacle");
    return;
  }
  const std::string& place = obstacle.source.of("other");
  refuse_unknown_body(scene, obstacle.other, place);
  const Scene::Body &slave = scene.body(obstacle.body), &master = scene.body(obstacle.other);
  for (const Scene::Body* body : {&slave, &master})
    if (body->equation != Scene::Equation::elasticity)
      input_error(place, fmt::format("body '{}' has equation = 'diffusion'; expected two elastic bodies", body->name));
  if (obstacle.shape) input_error(obstacle.source.of("shape"), "'shape' has no meaning beside 'other'");
  if (slave.name == master.name && !obstacle.other_on)
    input_error(place,
                "a body that touches itself needs 'other_on' or 'other_where': the part that the one of 'on' "
                "or 'where' touches");
  if (slave.plane != master.plane)
    input_error(place, fmt::format("bodies '{}' and '{}' differ in 'plane'; bodies that touch have the same",
                                   slave.name, master.name));
  if (slave.order != master.order)
    input_error((slave.order == 1 ? slave : master).source.of("order"),
                fmt::format("bodies '{}' and '{}' have elements of order {} and {}; bodies that touch each other have "
                            "the same in this version",
                            slave.name, master.name, slave.order, master.order));
  if (slave.pressure != master.pressure)
    input_error(place, fmt::format("bodies '{}' and '{}' differ in 'pressure'; bodies that touch have the same",
                                   slave.name, master.name));
}

// Without normals (inside the body) only a scalar unknown can meet an obstacle.
void check_obstacles(const Scene& scene) {
  for (const Scene::Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.on && !scalar(scene, obstacle.body))
      input_error(obstacle.source.table, "neither 'on' nor 'where' is given, expected one of them");
    check_other(scene, obstacle);
    check_pretension(scene, obstacle);
  }
}

void check_contact(const Scene& scene) {
  if (!scene.contact) return;
  const std::string& place = scene.contact->source.of("between");
  for (const std::string& name : scene.contact->between) {
    refuse_unknown_body(scene, name, place);
    if (std::ranges::count(scene.contact->between, name) > 1)
      input_error(place, fmt::format("body {} is listed twice", in_quotes(name)));
    if (scalar(scene, name))
      input_error(place, fmt::format("body '{}' has equation = 'diffusion'; expected elastic bodies", name));
  }
  if (std::ranges::count_if(scene.bodies, [&](const auto& body) { return scene.looks_for_pairs(body); }) < 2)
    input_error(place, "there are not two elastic bodies in the scene");
}

template <class Table>
bool any_of(const std::vector<Table>& tables, const Scene::Body& body) {
  return std::any_of(tables.begin(), tables.end(), [&](const Table& table) { return table.body == body.name; });
}

bool is_touched(const Scene& scene, const Scene::Body& body) {
  return scene.looks_for_pairs(body) ||
         std::ranges::any_of(scene.obstacles, [&](const auto& obstacle) { return obstacle.other == body.name; });
}

void check_held(const Scene& scene, const std::string& place) {
  for (const Scene::Body& body : scene.bodies)
    if (!any_of(scene.fixes, body) && !any_of(scene.springs, body) && !any_of(scene.rigids, body) &&
        !any_of(scene.obstacles, body) && !is_touched(scene, body) && scene.symmetry.planes.empty())
      input_error(scene.bodies.size() == 1 ? place : body.source.table,
                  "there is neither [[fix]] nor [[spring]] nor [[obstacle]]: nothing holds the body");
}

// Across the radius every axisymmetric body is symmetric already.
void check_symmetry(const Scene& scene) {
  for (const Mirror& mirror : scene.symmetry.planes)
    for (const Scene::Body& body : scene.bodies)
      if (body.plane == Plane::axisymmetric && mirror.axis == 0)
        input_error(scene.symmetry.source.of(axis_name(mirror.axis)),
                    fmt::format("a plane of symmetry across x, which is the radius of the axisymmetric body {}; "
                                "expected 'y', across its axis, alone",
                                in_quotes(body.name)));
}

/// What an adaptive run is for.
void check_goal(const Scene& scene) {
  const Scene::Refine& refine = scene.refine;
  if (refine.is_for_energy()) return;
  const auto fail = [&](const std::string& what) { input_error(refine.source.of("goal"), what); };
  if (!refine.adaptive) fail("'goal' has no meaning without adaptive = true");
  if (const std::string name = refine.goal_probe(); !name.empty()) {
    std::vector<std::string> names;
    for (const Scene::Probe& probe : scene.probes) names.push_back(probe.name);
    if (std::ranges::find(names, name) != names.end()) return;
    const std::string near = did_you_mean(name, names);
    fail(fmt::format("there is no probe {}{}", in_quotes(name),
                     near.empty() ? fmt::format(" (probes: {})", fmt::join(names, ", ")) : near));
  }
  const std::vector<std::string> goals{"energy", "force", "peak_pressure", "probe NAME"};
  if (refine.goal != goals[1] && refine.goal != goals[2])
    fail(fmt::format("unknown goal {}{} (goals: {})", in_quotes(refine.goal), did_you_mean(refine.goal, goals),
                     fmt::join(goals, ", ")));
  if (scene.obstacles.empty() && !scene.contact)
    fail(fmt::format("goal = \"{}\" is what an obstacle exerts, and there is no [[obstacle]]", refine.goal));
}

void check_common_dimension(const Scene& scene) {
  for (const Scene::Body& body : scene.bodies)
    if (const int found = dimension_of(body); found != 0 && found != scene.dimension)
      input_error(body.source.of("shape"), fmt::format("a body with {} dimensions, expected {} as the bodies before it",
                                                       found, scene.dimension));
}

// Directions of no length, as far as they are known without a position.
void check_direction(const std::vector<Field>& direction, const std::string& place) {
  const bool zero = std::all_of(direction.begin(), direction.end(), [](const Field& f) { return f.constant() == 0.0; });
  if (zero) input_error(place, "this vector is zero, expected a direction");
}

struct ShapeCheck {
  const Scene::Source& source;
  std::size_t dimension;

  void vector(const std::vector<Field>& fields, std::string_view key) const {
    expect_length(fields.size(), dimension, source.of(key), "coordinate");
    for (const Field& field : fields) expect_finite(field, source.of(key));
  }
  void direction(const std::vector<Field>& fields, std::string_view key) const {
    vector(fields, key);
    check_direction(fields, source.of(key));
  }
  void only_3d() const {
    if (dimension != 3) input_error(source.of("shape"), "this shape is for 3D scenes");
  }

  void operator()(const Scene::PlaneShape& plane) const {
    vector(plane.point, "point");
    direction(plane.normal, "normal");
  }
  void operator()(const Scene::SphereShape& sphere) const { vector(sphere.center, "center"); }
  void operator()(const Scene::CylinderShape& cylinder) const {
    only_3d();
    vector(cylinder.center, "center");
    direction(cylinder.axis, "axis");
  }
  void operator()(const Scene::SurfaceShape&) const { only_3d(); }
  void operator()(const Scene::ExpressionShape& expression) const {
    if (source.given("normal") && !expression.normal.empty()) direction(expression.normal, "normal");
  }
};

template <class Values>
void expect_if_given(const Scene::Source& source, const Values& values, const char* key, std::size_t expected,
                     const char* what) {
  if (source.given(key)) expect_length(values.size(), expected, source.of(key), what);
}

void check_lengths(const Scene::Rigid& rigid, std::size_t dimension) {
  const std::size_t rotations = dimension * (dimension - 1) / 2;
  expect_if_given(rigid.source, rigid.point, "point", dimension, "coordinate");
  expect_if_given(rigid.source, rigid.displacement, "displacement", dimension, "component");
  expect_if_given(rigid.source, rigid.force, "force", dimension, "component");
  expect_if_given(rigid.source, rigid.rotation, "rotation", rotations, "component");
  expect_if_given(rigid.source, rigid.torque, "torque", rotations, "component");
}

}  // namespace

void check_dimension(const Scene& scene, int dimension) {
  const auto components = [&](const std::string& body) -> std::size_t { return scalar(scene, body) ? 1 : dimension; };
  for (const Scene::Body& body : scene.bodies)
    if (dimension == 3 && body.source.given("plane"))
      input_error(body.source.of("plane"), "'plane' is for 2D bodies, this one is 3D");
  for (const Scene::Body& body : scene.bodies) check_orthotropic(body, dimension);
  for (const Mirror& mirror : scene.symmetry.planes)
    if (mirror.axis >= dimension)
      input_error(scene.symmetry.source.of(axis_name(mirror.axis)),
                  fmt::format("a plane of symmetry across {}, and the scene has {} dimensions", axis_name(mirror.axis),
                              dimension));
  for (const Scene::Fix& fix : scene.fixes) {
    check_point(fix.on, dimension);
    check_axis(fix, dimension);
    expect_length(fix.value.size(), components(fix.body), fix.source.of("value"), "component");
  }
  check_load_lengths(scene, dimension);
  check_spring_lengths(scene, dimension);
  for (const Scene::Rigid& rigid : scene.rigids) check_lengths(rigid, static_cast<std::size_t>(dimension));
  for (const Scene::Probe& probe : scene.probes)
    expect_length(probe.at.size(), dimension, probe.source.of("at"), "coordinate");
  for (const Scene::Obstacle& obstacle : scene.obstacles)
    if (obstacle.shape) std::visit(ShapeCheck{obstacle.source, static_cast<std::size_t>(dimension)}, *obstacle.shape);
}

void check_scene(const Scene& scene, const std::string& place) {
  if (scene.bodies.empty()) input_error(place, "there is no [[body]]");
  check_unique(scene.bodies);
  check_unique(scene.probes);
  check_bodies(scene, scene.materials);
  check_coefficients(scene);
  check_materials(scene);
  check_bodies(scene, scene.fixes);
  check_bodies(scene, scene.loads);
  check_bodies(scene, scene.springs);
  check_bodies(scene, scene.rigids);
  check_bodies(scene, scene.obstacles);
  check_bodies(scene, scene.probes);
  check_fixes(scene);
  check_loads(scene);
  check_springs(scene);
  check_rigids(scene);
  check_obstacles(scene);
  check_contact(scene);
  check_held(scene, place);
  check_symmetry(scene);
  check_goal(scene);
  check_common_dimension(scene);
  if (scene.dimension != 0) check_dimension(scene, scene.dimension);
}

}  // namespace signorini
