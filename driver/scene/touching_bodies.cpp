#include "driver/scene/touching_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "core/fem/motions/rigid_motions.hpp"
#include "core/mesh/join.hpp"
#include "driver/scene/numbers.hpp"

namespace signorini {
namespace {

std::size_t number_of(const Scene& scene, const std::string& body) {
  return static_cast<std::size_t>(std::ranges::find(scene.bodies, body, &Scene::Body::name) - scene.bodies.begin());
}

/// Per body the first one of those that it touches, directly or through others.
std::vector<std::size_t> groups(const Scene& scene) {
  std::vector<std::size_t> group(scene.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  for (const Scene::Obstacle& obstacle : scene.obstacles) {
    if (obstacle.other.empty()) continue;
    const auto [first, last] =
        std::minmax({group[number_of(scene, obstacle.body)], group[number_of(scene, obstacle.other)]});
    std::ranges::replace(group, last, first);
  }
  return group;
}

bool touches(const Scene& scene, const Scene::Body& body) {
  return std::ranges::any_of(scene.obstacles, [&](const Scene::Obstacle& obstacle) {
    return !obstacle.other.empty() && (obstacle.body == body.name || obstacle.other == body.name);
  });
}

Scene::Body joined(std::vector<Scene::Body> parts) {
  if (parts.size() > most_bodies)
    input_error(parts.front().source.table,
                fmt::format("{} bodies touch each other, expected at most {}", parts.size(), most_bodies));
  Scene::Body body;
  for (const Scene::Body& part : parts) body.name += (body.name.empty() ? "" : "+") + part.name;
  body.equation = parts.front().equation;
  body.plane = parts.front().plane;
  body.order = parts.front().order;
  body.order_chosen = std::ranges::all_of(parts, &Scene::Body::order_chosen);
  body.pressure = parts.front().pressure;
  body.source.table = parts.front().source.table;
  for (std::size_t k = 1; k < parts.size(); ++k) body.source.table += ", " + parts[k].source.table;
  body.parts = std::move(parts);
  return body;
}

}  // namespace

Scene with_touching_bodies(const Scene& scene) {
  Scene out = scene;
  out.bodies.clear();
  const std::vector<std::size_t> group = groups(scene);
  for (std::size_t first = 0; first < group.size(); ++first) {
    std::vector<Scene::Body> parts;
    for (std::size_t k = first; k < group.size(); ++k)
      if (group[k] == first) parts.push_back(scene.bodies[k]);
    if (parts.empty()) continue;
    const bool alone = !touches(scene, parts.front());
    out.bodies.push_back(alone ? std::move(parts.front()) : joined(std::move(parts)));
  }
  return out;
}

std::pair<Index, Index> regions_of_part(const Scene& scene, const Scene::Body& body, std::size_t part) {
  Index first = 0;
  const auto count = [&](std::size_t k) {
    return static_cast<Index>(1 + numbers_of(scene.materials, body.parts[k]).size());
  };
  for (std::size_t k = 0; k < part; ++k) first += count(k);
  return {first, count(part)};
}

Scene::Solver solver_options(const Scene& scene, const Scene::Body& body) {
  Scene::Solver options = scene.solver;
  if (body.parts.empty()) return options;
  if (options.hierarchy == "auto") options.hierarchy = "meshes";
  return options;
}

std::string side_of(const Scene::Obstacle& obstacle, bool other) {
  const std::string& body = other ? obstacle.other : obstacle.body;
  if (obstacle.body != obstacle.other) return body;
  const std::optional<Selection>& on = other ? obstacle.other_on : obstacle.on;
  if (on && on->part) return part_of(body, *on->part);
  return fmt::format("{} ({})", body, other ? "other_where" : "where");
}

Selection on_mesh_of(const Scene::Body& body, const std::string& part, Selection selection) {
  if (body.parts.empty()) return selection;
  selection.part = part_of(part, selection.part.value_or("boundary"));
  if (selection.other) selection.other = part_of(part, *selection.other);
  return selection;
}

}  // namespace signorini
