#include "driver/scene/build_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <span>

#include "core/base/error.hpp"
#include "core/component/failure.hpp"
#include "core/component/new_obstacle.hpp"
#include "core/component/settings.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/mesh/mirror.hpp"
#include "core/scene/rigid_shape.hpp"
#include "core/scene/specs.hpp"
#include "core/sdk/tying.hpp"
#include "driver/scene/materials.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini {
namespace {

template <int B>
[[noreturn]] void wrong_equation(const Scene::Obstacle& scene, const ObstacleType& type) {
  const bool scalar = type.create1, elastic = type.create2 || type.create3;
  const std::string& place = scene.source.of("type");
  if (B == 1 && elastic)
    input_error(place, fmt::format("the obstacle type '{}' is for elastic bodies, and body '{}' has equation = "
                                   "'diffusion'; expected a type for scalar unknowns, such as 'scalar'",
                                   scene.type, scene.body));
  if (B > 1 && scalar && !elastic)
    input_error(place, fmt::format("the obstacle type '{}' is for scalar unknowns, and body '{}' has equation = "
                                   "'elasticity'; expected a type for elastic bodies, such as 'contact'",
                                   scene.type, scene.body));
  input_error(place, fmt::format("the obstacle type '{}' knows no problem with {} unknowns per vertex", scene.type, B));
}

/// The keys of a shape that was forgotten are no unknown options.
void expect_shape(const Scene::Obstacle& scene, const ObstacleType& type) {
  const std::span options(type.options, type.option_count);
  for (const auto& [entry, raw] : scene.options.entries) {
    const std::string& key = entry;  // a binding cannot be captured everywhere
    if (std::ranges::any_of(options, [&](const OptionSpec& option) { return key == option.name; })) continue;
    for (const ShapeSpec& shape : obstacle_shapes())
      if (find_key(shape.keys, key))
        input_error(raw.origin, fmt::format("missing key 'shape': '{}' is a key of shape '{}'", key, shape.name));
  }
}

/// Tells an obstacle that depends on its step which one it is.
template <int B>
void begin_step(Obstacle<B>& obstacle, const LoadStep& step, const Scene::Obstacle& scene, const Registry& registry) {
  auto* stepping = dynamic_cast<Stepping*>(&obstacle);
  if (!stepping) return;
  Status status;
  stepping->begin(step, status);
  if (!status.ok())
    throw_failure(
        status, failed_call(status, scene.source.table, registry.entry("obstacle", scene.type), "beginning of a step"));
}

/// The obstacle with the settings it holds on to.
template <int B>
ObstacleTerm<B> create_obstacle(const Scene::Obstacle& scene, int dimension, const Registry& registry,
                                const LoadStep& step) {
  const double t = step.to;
  const ObstacleType& type = registry.obstacle(scene.type);
  const std::string& origin = scene.source.table;
  if (!constructor<B>(type)) wrong_equation<B>(scene, type);
  if (scene.other.empty() && type.takes_body)
    input_error(origin, fmt::format("missing key 'other': the obstacle type '{}' acts between two bodies", scene.type));
  if (scene.shape && !type.takes_shape)
    input_error(scene.source.of("shape"), fmt::format("the obstacle type '{}' takes no shape", scene.type));
  if (!scene.shape && type.takes_shape) expect_shape(scene, type);
  if (!scene.other.empty() && !type.takes_body)
    input_error(scene.source.of("other"),
                fmt::format("the obstacle type '{}' acts on one body, expected no 'other'", scene.type));
  std::shared_ptr<const DistanceFunction> shape;
  if (scene.shape) shape = rigid_shape(*scene.shape, dimension, t, origin);
  auto settings = compile_settings(fmt::format("obstacle '{}'", scene.type), {type.options, type.option_count},
                                   scene.options, scene.core_keys(), shape, t);
  const std::shared_ptr<Obstacle<B>> obstacle =
      new_obstacle<B>(type, registry.entry("obstacle", scene.type), settings, origin);
  begin_step(*obstacle, step, scene, registry);
  check_asked(*settings, origin);
  return {obstacle, scene.on, origin, std::move(shape), {}, std::move(settings)};
}

/// Of a tie; nothing where bodies may part.
template <int B>
std::optional<double> adjust(const Scene::Obstacle& scene, const Obstacle<B>& obstacle) {
  const auto* tying = dynamic_cast<const Tying*>(&obstacle);
  if (!tying) return {};
  for (const char* key : {"resolve", "renew"})
    if (scene.source.given(key))
      input_error(scene.source.of(key), fmt::format("'{}' has no meaning where bodies are tied to each other", key));
  return tying->adjust();
}

template <int B>
std::optional<Pretension> pretension(const Scene& scene, const Scene::Obstacle& obstacle, const ObstacleTerm<B>& term,
                                     double t) {
  if (!obstacle.pretension) return {};
  const std::string& place = obstacle.source.of("pretension");
  if (!term.tied)
    input_error(place,
                fmt::format("bolts are cut, and their parts tied to each other: expected type = 'tied', not '{}'",
                            obstacle.type));
  Pretension out{*obstacle.pretension, {}, place};
  if (obstacle.locked(scene.steps, t)) out.locked = 0;  // where no step has found another one
  return out;
}

template <int B>
LocalFrame<B> frame(Frame kind, const Scene::FrameAxis& axis) {
  LocalFrame<B> out = kind;
  std::ranges::copy(axis.center, out.center.begin());
  std::ranges::copy(axis.direction, out.axis.begin());
  return out;
}

template <int B>
Fix<B> fix(const Scene::Body& body, const Scene::Fix& given) {
  Fix<B> result{on_mesh_of(body, given.body, given.on), {}, frame<B>(given.frame, given.axis)};
  std::copy_n(given.value.begin(), B, result.value.begin());
  return result;
}

/// The same vectors by their components in space.
template <int B>
std::array<Field, B> in_space(const LocalFrame<B>& frame, const std::array<Field, B>& components) {
  if (frame.kind == Frame::global) return components;
  std::string text = fmt::format("frame {} ({}) ({})", static_cast<int>(frame.kind), fmt::join(frame.center, ", "),
                                 fmt::join(frame.axis, ", "));
  for (const Field& component : components) text += "; " + component.text();
  const bool uses_t = std::ranges::any_of(components, [](const Field& field) { return field.uses_t(); });
  std::array<Field, B> out;
  for (int i = 0; i < B; ++i)
    out[i] = Field(
        [frame, components, i](const Site& site) {
          Point<B> x, normal;
          std::copy_n(site.x, B, x.begin());
          std::copy_n(site.n, B, normal.begin());
          const auto direction = directions<B, B>(frame, x, normal);
          double sum = 0;
          for (int k = 0; k < B; ++k) sum += components[k](site) * direction[k][i];
          return sum;
        },
        fmt::format("component {} of {}", i, text), components[0].origin(), frame.kind == Frame::normal, uses_t);
  return out;
}

/// The traction of a pressure.
template <int B>
std::array<Field, B> against_normal(const Field& pressure) {
  std::array<Field, B> value;
  for (int i = 0; i < B; ++i)
    value[i] =
        Field([pressure, i](const Site& site) { return -pressure(site) * site.n[i]; },
              fmt::format("-({}) * n{}", pressure.text(), axis_name(i)), pressure.origin(), true, pressure.uses_t());
  return value;
}

template <int B>
Resultant<B> resultant(const Scene::Load& given) {
  Resultant<B> total{.force = {},
                     .torque = given.torque,
                     .about = {},
                     .origin = given.source.of(given.force.empty() ? "torque" : "force")};
  std::ranges::copy(given.force, total.force.begin());
  if (given.about.empty()) return total;
  std::ranges::copy(given.about, total.about.emplace().begin());
  if (total.torque.empty()) total.torque.assign(B == 3 ? 3 : 1, Field(0.0));
  return total;
}

template <int B>
RigidPart<B> rigid_part(const Scene::Body& body, const Scene::Rigid& given) {
  RigidPart<B> result{on_mesh_of(body, given.body, given.on), {}, {}, {}, {}, {}};
  if (!given.point.empty()) std::copy_n(given.point.begin(), B, result.point.emplace().begin());
  const auto take = [](const auto& from, auto& to) {
    std::copy_n(from.begin(), std::min(from.size(), to.size()), to.begin());
  };
  take(given.displacement, result.displacement);
  take(given.rotation, result.rotation);
  take(given.force, result.force);
  take(given.torque, result.torque);
  return result;
}

template <int B>
Load<B> load(const Scene& scene, const Scene::Body& body, const Scene::Load& given) {
  Load<B> result{given.on, {}};
  std::ranges::copy(given.value, result.value.begin());
  if constexpr (B > 1) result.value = in_space<B>(frame<B>(given.frame, given.axis), result.value);
  if (given.pressure) result.value = against_normal<B>(*given.pressure);
  if (given.is_total()) result.total = resultant<B>(given);
  if (given.on) result.on = on_mesh_of(body, given.body, *given.on);
  if (given.where_open) result.where_open.emplace();
  if (!given.from.empty())
    result.where_open->from = on_mesh_of(body, given.body, {given.from, {}, given.source.of("from")});
  if (given.on || body.parts.empty()) return result;
  const auto part = std::ranges::find(body.parts, given.body, &Scene::Body::name) - body.parts.begin();
  const auto [first, count] = regions_of_part(scene, body, static_cast<std::size_t>(part));
  result.regions = {first, first + count - 1};
  return result;
}

template <int B>
Orthotropy<B> orthotropy(const Scene::Orthotropic& given) {
  using Vector = Eigen::Vector3d;
  const auto vector = [](const std::vector<double>& x) {
    return Vector(x[0], x[1], x.size() > 2 ? x[2] : 0).normalized();
  };
  Vector first = Vector::UnitX(), second = Vector::UnitY();
  if (!given.axes.empty()) {
    first = vector(given.axes[0]);
    second = B == 3 ? vector(given.axes[1]) : Vector(-first[1], first[0], 0);
    second = (second - first.dot(second) * first).normalized();
  }
  const Vector third = first.cross(second);
  Orthotropy<B> out{given.constants, {}, {}};
  const std::array<Vector, 3> axes{first, second, third};
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(axes[k].data(), 3, out.axes[k].begin());
  if (!given.center.empty()) out.frame = frame<B>(Frame::cylindrical, {given.center, given.axis});
  return out;
}

/// Per region of a body; empty where all is isotropic.
template <int B>
std::vector<std::shared_ptr<const Orthotropy<B>>> orthotropies(const Scene& scene, const Scene::Body& body) {
  std::vector<std::shared_ptr<const Orthotropy<B>>> out;
  const std::span<const Scene::Body> bodies = body.parts.empty() ? std::span(&body, 1) : std::span(body.parts);
  if (std::ranges::none_of(bodies, [](const Scene::Body& part) { return part.orthotropic.has_value(); })) return out;
  for (const Scene::Body& part : bodies) {
    out.push_back(part.orthotropic ? std::make_shared<const Orthotropy<B>>(orthotropy<B>(*part.orthotropic)) : nullptr);
    out.resize(out.size() + numbers_of(scene.materials, part).size());
  }
  return out;
}

/// Or one of its parts.
bool is_heated(const Scene::Body& body) {
  return body.temperature.constant() != 0.0 || std::ranges::any_of(body.parts, is_heated);
}

/// Where pressure enters a joint, contact has to be known at the faces that the scene names.
Slave slave_of(const Scene& scene, const Scene::Obstacle& obstacle) {
  if (obstacle.slave != Slave::automatic || obstacle.body == obstacle.other) return obstacle.slave;
  const auto enters = [&](const std::string& body) {
    return std::ranges::any_of(scene.loads, [&](const auto& load) { return load.where_open && load.body == body; });
  };
  if (enters(obstacle.body)) return Slave::body;
  return enters(obstacle.other) ? Slave::other : Slave::automatic;
}

template <int B>
Spring<B> spring(const Scene::Body& body, const Scene::Spring& given) {
  Spring<B> result{on_mesh_of(body, given.body, given.on), {}, given.total, frame<B>(given.frame, given.axis)};
  for (std::size_t i = 0; i < B; ++i) result.stiffness[i] = given.stiffness[given.stiffness.size() == 1 ? 0 : i];
  return result;
}

}  // namespace

template <int B>
Model<B> build_model(const Scene& scene, int dimension, const Registry& registry, const LoadStep& step,
                     std::size_t number) {
  const Scene::Body& body = scene.bodies[number];
  Model<B> model;
  model.diffusion = coefficient(scene, body, &Scene::Body::diffusion, &Scene::Material::diffusion);
  model.young = coefficient(scene, body, &Scene::Body::young, &Scene::Material::young);
  model.poisson = coefficient(scene, body, &Scene::Body::poisson, &Scene::Material::poisson);
  if constexpr (B > 1) model.orthotropic = orthotropies<B>(scene, body);
  model.first_region = body.parts.empty() ? -1 : 0;
  if (is_heated(body)) {
    model.expansion = coefficient(scene, body, &Scene::Body::expansion, &Scene::Material::expansion);
    model.temperature = coefficient(scene, body, &Scene::Body::temperature);
  }
  model.plane = body.plane;
  model.pressure = body.pressure.value_or(Pressure::none);
  model.t = step.to;
  model.origin = body.source.table;
  for (const int k : numbers_of(scene.fixes, body)) model.fixes.push_back(fix<B>(body, scene.fixes[k]));
  for (const int k : numbers_of(scene.loads, body)) model.loads.push_back(load<B>(scene, body, scene.loads[k]));
  for (const int k : numbers_of(scene.springs, body)) model.springs.push_back(spring<B>(body, scene.springs[k]));
  if constexpr (B > 1)
    for (const int k : numbers_of(scene.rigids, body)) model.rigid.push_back(rigid_part<B>(body, scene.rigids[k]));
  for (const int k : numbers_of(scene.obstacles, body)) {
    const Scene::Obstacle& obstacle = scene.obstacles[k];
    ObstacleTerm<B>& term = model.obstacles.emplace_back(create_obstacle<B>(obstacle, dimension, registry, step));
    if (term.on) term.on = on_mesh_of(body, obstacle.body, *term.on);
    term.renew = obstacle.renew;
    if (obstacle.other.empty()) continue;
    term.other =
        on_mesh_of(body, obstacle.other, obstacle.other_on.value_or(Selection{{}, {}, obstacle.source.of("other")}));
    term.slave = slave_of(scene, obstacle);
    term.pairing = obstacle.pairing;
    term.resolve = obstacle.resolve;
    term.adjust = obstacle.adjust;
    term.tied = adjust<B>(obstacle, *term.obstacle);
    term.pretension = pretension(scene, obstacle, term, step.to);
  }
  return model;
}

template <int B>
void place_before(const Scene& scene, int dimension, double t, std::size_t body, Model<B>& model) {
  std::size_t next = 0;
  for (const int k : numbers_of(scene.obstacles, scene.bodies[body])) {
    ObstacleTerm<B>& term = model.obstacles[next++];
    const auto& shape = scene.obstacles[k].shape;
    if (!term.obstacle->functional() || !shape || std::holds_alternative<Scene::SurfaceShape>(*shape)) continue;
    term.shape_before = rigid_shape(*shape, dimension, t, term.origin);
  }
}

template void place_before(const Scene&, int, double, std::size_t, Model<1>&);
template void place_before(const Scene&, int, double, std::size_t, Model<2>&);
template void place_before(const Scene&, int, double, std::size_t, Model<3>&);
template Model<1> build_model(const Scene&, int, const Registry&, const LoadStep&, std::size_t);
template Model<2> build_model(const Scene&, int, const Registry&, const LoadStep&, std::size_t);
template Model<3> build_model(const Scene&, int, const Registry&, const LoadStep&, std::size_t);

}  // namespace signorini
