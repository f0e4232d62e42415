#include "apps/signorini/cheaper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/signorini/console.hpp"
#include "apps/signorini/evenness.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mirror.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/found_pairs.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/symmetry.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini {
namespace {

constexpr double as_rigid = 1e3;  // times as stiff: contact widths and approaches then change by a thousandth

/// Of all vertices, along the axes.
struct Extent {
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  template <int D>
  void add(const Mesh<D>& mesh) {
    for (const Point<D>& x : mesh.points)
      for (int i = 0; i < D; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
  }
  /// But for rounding.
  double middle(int axis) const {
    const double step = std::pow(10, std::floor(std::log10(high[axis] - low[axis])) - 8);
    return step * std::round(0.5 * (low[axis] + high[axis]) / step) + 0.0;
  }
};

/// As coarse as symmetry can be looked at.
Scene coarse(Scene scene) {
  add_found_pairs(scene);
  scene.dimension = dimension_of(scene);
  scene = with_touching_bodies(scene);
  scene.refine.uniform = std::min(scene.refine.uniform, 1);
  for (Scene::Body& body : scene.bodies) body.order = 1;
  return scene;
}

Extent extent_of(const Scene& scene) {
  Extent out;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    dispatch(
        scene,
        [&]<int D, int B>() { out.add(build_hierarchy<D>(scene, B, nullptr, Console(true), body).levels.front()); },
        body);
  return out;
}

/// Calls use(meshes of a body, its model at the end of a step) for all bodies and steps. False where one of them
/// refuses the scene, or returns false.
template <class Use>
bool all_agree(const Scene& scene, const Registry& registry, const Use& use) {
  bool agree = true;
  try {
    for (std::size_t body = 0; body < scene.bodies.size() && agree; ++body)
      dispatch(
          scene,
          [&]<int D, int B>() {
            const MeshHierarchy<D> meshes = build_hierarchy<D>(scene, B, nullptr, Console(true), body);
            double before = 0;
            for (const double t : scene.steps.at) {
              Model<B> model = build_model<B>(scene, D, registry, t, body);
              place_before(scene, D, before, body, model);
              before = t;
              agree = agree && use(meshes, model, scene.bodies[body]);
            }
          },
          body);
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted) throw;
    return false;
  }
  return agree;
}

/// The half as the solve looks at it.
bool is_symmetric(const Scene& half, const Registry& registry) {
  return all_agree(half, registry,
                   []<int D, int B>(const MeshHierarchy<D>& meshes, const Model<B>& model, const auto&) {
                     check_symmetry(meshes, model);
                     return true;
                   });
}

/// What acts in the half that is left out.
bool is_even(const Scene& whole, const Mirror& plane, const Registry& registry) {
  return all_agree(whole, registry,
                   [&]<int D, int B>(const MeshHierarchy<D>& meshes, const Model<B>& model, const Scene::Body& body) {
                     const bool any_shape = std::holds_alternative<geometry::Polygon>(body.shape);
                     return is_even(meshes.levels.front(), model, plane, any_shape);
                   });
}

bool comes_from_file(const Scene::Body& body) {
  return std::holds_alternative<Scene::MeshFile>(body.shape) || std::holds_alternative<geometry::Solid>(body.shape);
}

std::vector<std::string> planes_of_symmetry(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides, const Scene& scene,
                                            const Registry& registry) {
  std::vector<std::string> out;
  if (std::ranges::any_of(scene.bodies, comes_from_file)) return out;
  const Scene whole = coarse(scene);
  const Extent extent = extent_of(whole);
  for (int axis = 0; axis < dimension_of(scene); ++axis) {
    if (std::ranges::any_of(scene.symmetry.planes, [&](const Mirror& mirror) { return mirror.axis == axis; })) continue;
    const Mirror middle{axis, extent.middle(axis)};
    const std::string plane = fmt::format("{}={:.9g}", axis_name(axis), middle.at);
    std::vector<std::string> with = overrides;
    with.push_back("symmetry." + plane);
    std::optional<Scene> halved;
    try {
      halved = coarse(read_scene(file, with));
    } catch (const Error&) {
      continue;
    }
    if (is_even(whole, middle, registry) && is_symmetric(*halved, registry))
      out.push_back(
          fmt::format("symmetric about {}: `--set symmetry.{}` solves half of it, with the same answer", plane, plane));
  }
  return out;
}

bool is_zero(const RawValue& value) {
  const auto* number = std::get_if<double>(&value.value);
  const auto* whole = std::get_if<std::int64_t>(&value.value);
  return (number && *number == 0) || (whole && *whole == 0);
}

void add_frictionless(const Scene& scene, std::vector<std::string>& out) {
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const Scene::Obstacle& obstacle = scene.obstacles[k];
    const RawValue* friction = obstacle.options.find("friction");
    if (!friction || !is_zero(*friction)) continue;
    out.push_back(fmt::format("obstacle {}: friction 0: type = \"{}\" is the same without it", k,
                              obstacle.other.empty() ? "contact" : "elastic"));
  }
}

const Scene::Body* body_named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.bodies, name, &Scene::Body::name);
  return found == scene.bodies.end() ? nullptr : &*found;
}

void add_rigid(const Scene& scene, std::vector<std::string>& out) {
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const Scene::Body* one = body_named(scene, scene.obstacles[k].body);
    const Scene::Body* other = body_named(scene, scene.obstacles[k].other);
    if (!one || !other || one == other) continue;
    if (one->orthotropic || other->orthotropic) continue;  // how stiff is a matter of direction
    if (one->temperature.constant() != 0.0 || other->temperature.constant() != 0.0)
      continue;  // what is rigid grows not
    const auto soft = one->young.constant(), stiff = other->young.constant();
    if (!soft || !stiff) continue;
    const double ratio = std::max(*soft / *stiff, *stiff / *soft);
    if (ratio >= as_rigid)
      out.push_back(
          fmt::format("obstacle {}: '{}' is {:.2g} times as stiff as the other body: a rigid obstacle in its "
                      "place changes displacements near the contact by about {:.1e} of themselves",
                      k, (*soft > *stiff ? one : other)->name, ratio, 1 / ratio));
  }
}

}  // namespace

std::vector<std::string> cheaper_models(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                                        const Scene& scene, const Registry& registry) {
  std::vector<std::string> out = planes_of_symmetry(file, overrides, scene, registry);
  add_frictionless(scene, out);
  add_rigid(scene, out);
  return out;
}

}  // namespace signorini
