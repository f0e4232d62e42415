#include "driver/scene/found_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/across.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mortar/couple.hpp"
#include "core/scene/read_tables.hpp"
#include "driver/scene/coarse_mesh.hpp"

namespace signorini {
namespace {

/// Of the faces' longest edge: what is so much farther off than another body is behind that.
constexpr double behind = 0.01;

/// Per vertex how far the other body is; infinite where it is not in front.
using Distances = std::vector<double>;

/// The boundary of one body.
template <int D>
struct BodySide {
  const Scene::Body* body;
  Mesh<D> mesh;
  std::vector<Index> faces;  // all
  Point<D> low, high;        // of the box around it
  double longest = 0;        // edge of its faces
  Distances itself;          // how far its own surface is, in front of it

  BodySide(const Scene& scene, std::size_t number)
      : body(&scene.bodies[number]), mesh(coarsest_mesh<D>(scene, number, D, nullptr, Progress())) {
    faces.resize(mesh.boundary.size());
    std::iota(faces.begin(), faces.end(), Index{0});
    low = high = mesh.points.front();
    for (const Point<D>& x : mesh.points)
      for (int i = 0; i < D; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    for (const Face<D>& face : mesh.boundary) longest = std::max(longest, longest_edge(mesh, face));
  }
};

/// Adds the faces that hang together with those that are picked, but for creases.
template <int D>
void spread(const Mesh<D>& mesh, std::vector<char>& picked) {
  std::map<std::array<Index, D - 1>, std::vector<std::size_t>> around;  // faces by the vertices of their edges
  std::vector<Point<D>> normals;
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const Face<D>& face = mesh.boundary[f];
    normalise(normals.emplace_back(area_normal(mesh, face)));
    for (int opposite = 0; opposite < D; ++opposite) {
      std::array<Index, D - 1> edge;
      for (int i = 0; i < D - 1; ++i) edge[i] = face.vertices[(opposite + 1 + i) % D];
      std::ranges::sort(edge);
      around[edge].push_back(f);
    }
  }
  std::vector<std::vector<std::size_t>> next(normals.size());
  for (const auto& [edge, faces] : around)
    for (const std::size_t f : faces)
      for (const std::size_t g : faces)
        if (dot(normals[f], normals[g]) > std::cos(geometry::default_crease)) next[f].push_back(g);
  std::vector<std::size_t> reached;
  for (std::size_t f = 0; f < picked.size(); ++f)
    if (picked[f]) reached.push_back(f);
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const std::size_t f : next[reached[k]])
      if (!std::exchange(picked[f], 1)) reached.push_back(f);
}

/// Two sides that may touch, by their numbers, and how each sees the other one.
struct Found {
  std::size_t first, second;
  double reach, least;
  std::array<Distances, 2> seen;
};

template <int D>
class Finder {
 public:
  explicit Finder(const Scene& scene) : scene_(scene), contact_(*scene.contact) {
    for (std::size_t k = 0; k < scene.bodies.size(); ++k)
      if (scene.looks_for_pairs(scene.bodies[k])) sides_.emplace_back(scene, k);
  }

  std::vector<FoundPair> add_to(Scene& out) {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (std::size_t j = i + 1; j < sides_.size(); ++j)
        if (!is_given(*sides_[i].body, *sides_[j].body)) look_at(i, j);
    std::vector<FoundPair> all;
    for (const Found& pair : found_) {
      if (picked(pair, 0)->empty() || picked(pair, 1)->empty()) continue;  // a third body is between them
      all.push_back({out.obstacles.size(), sides_[pair.first].body->name, sides_[pair.second].body->name, pair.least});
      out.obstacles.push_back(obstacle(pair));
    }
    if (all.empty()) refuse_none();
    return all;
  }

 private:
  /// Whether an obstacle of the scene is between two bodies.
  bool is_given(const Scene::Body& a, const Scene::Body& b) const {
    return std::ranges::any_of(scene_.obstacles, [&](const Scene::Obstacle& obstacle) {
      return std::minmax(obstacle.body, obstacle.other) == std::minmax(a.name, b.name);
    });
  }

  void look_at(std::size_t i, std::size_t j) {
    const BodySide<D>&a = sides_[i], &b = sides_[j];
    const double reach = contact_.reach.value_or(std::max(a.longest, b.longest));
    double extent = 0, apart = 0;  // of both, and of their boxes
    for (int k = 0; k < D; ++k) {
      const double from = std::min(a.low[k], b.low[k]), to = std::max(a.high[k], b.high[k]);
      extent += (to - from) * (to - from);
      apart = std::max({apart, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    }
    extent = std::sqrt(extent);
    nearest_ = std::min(nearest_, apart);
    // A distance along a normal is at most twice that of the boxes where faces are 60 degrees from opposite.
    if (apart > reach + rounding_of_differences * extent) return;
    Found out{i, j, reach + rounding_of_differences * extent, infinity, {}};
    const double depth = contact_.resolve ? extent : std::max(reach, contact_.adjust);
    out.seen = {distances(a, b, extent, depth), distances(b, a, extent, depth)};
    for (const Distances& seen : out.seen) out.least = std::min(out.least, std::ranges::min(seen));
    if (std::isfinite(out.least)) nearest_ = std::min(nearest_, std::max(out.least, 0.0));
    if (out.least <= out.reach) found_.push_back(std::move(out));
  }

  Distances distances(const BodySide<D>& from, const BodySide<D>& to, double reach, double depth) const {
    const auto corners = [](const BodySide<D>& side) {
      std::vector<std::array<Index, D>> out;
      for (const Face<D>& face : side.mesh.boundary) out.push_back(face.vertices);
      return out;
    };
    const auto own = corners(from), other = corners(to);
    const std::vector<Point<D>> points = to.mesh.points;  // another body's, even where it is the same: faces pair then
    const std::string& place = contact_.source.table;
    const MortarCoupling<D> coupling = couple<D>({from.mesh.points, own, place, 1, &from.mesh, from.faces},
                                                 {points, other, place, 1, &to.mesh, to.faces},
                                                 {.pairing = contact_.pairing,
                                                  .reach = reach,
                                                  .depth = depth,
                                                  .axisymmetric = from.body->plane == Plane::axisymmetric});
    Distances out(from.mesh.points.size(), infinity);
    for (Index k = 0; k < coupling.nodes(); ++k) out[coupling.node[k]] = coupling.nearest[k];
    return out;
  }

  /// How far the body's own surface is in front of it, as across a bore: what is behind that is out of sight.
  const Distances& itself(std::size_t number) {
    BodySide<D>& side = sides_[number];
    if (side.itself.empty()) {
      side.itself = distances(side, side, length<D>(difference<D>(side.high, side.low)), 0);
      for (double& distance : side.itself)
        if (distance <= 0) distance = infinity;  // behind it: the other side of a wall
    }
    return side.itself;
  }

  Scene::Obstacle obstacle(const Found& pair) {
    const Scene::Body &body = *sides_[pair.first].body, &other = *sides_[pair.second].body;
    Scene::Obstacle out;
    const RawValue* friction = contact_.friction ? &*contact_.friction : nullptr;
    out.type = friction && !is_zero(*friction) ? "elastic_coulomb" : "elastic";
    out.body = body.name;
    out.other = other.name;
    out.source = contact_.source;
    out.source.table += fmt::format(" between {} and {}", body.name, other.name);
    out.on = faces(pair, 0, out.source.table);
    out.other_on = faces(pair, 1, out.source.table);
    out.pairing = contact_.pairing;
    out.resolve = contact_.resolve;
    out.renew = contact_.renew;
    out.adjust = contact_.adjust;
    out.options.origin = out.source.table;
    if (out.type == "elastic_coulomb") out.options.entries.emplace_back("friction", *friction);
    return out;
  }

  static bool is_zero(const RawValue& value) {
    const auto* number = std::get_if<double>(&value.value);
    const auto* whole = std::get_if<std::int64_t>(&value.value);
    return (number && *number == 0) || (whole && *whole == 0);
  }

  using Corners = std::map<Point<D>, std::vector<Point<D>>>;  // normals of faces by vertex

  /// Of a side the faces that see the other one, and nothing in front of it: no third one, nothing of their own body.
  /// Bodies may move on, to where other faces see each other: all of the same surfaces are picked then.
  std::shared_ptr<const Corners> picked(const Found& pair, int which) {
    const std::size_t number = which == 0 ? pair.first : pair.second;
    const BodySide<D>& side = sides_[number];
    Distances nearest = itself(number);
    for (const Found& any : found_)
      for (const int k : {0, 1})
        if ((k == 0 ? any.first : any.second) == number)
          for (std::size_t v = 0; v < nearest.size(); ++v) nearest[v] = std::min(nearest[v], any.seen[k][v]);
    const Distances& seen = pair.seen[which];
    std::vector<char> in_sight;
    for (const Face<D>& face : side.mesh.boundary)
      in_sight.push_back(
          std::ranges::all_of(face.vertices, [&](Index v) { return std::isfinite(seen[v]); }) &&
          std::ranges::any_of(face.vertices, [&](Index v) { return seen[v] <= nearest[v] + behind * side.longest; }));
    if (contact_.renew) spread(side.mesh, in_sight);
    auto out = std::make_shared<Corners>();
    for (std::size_t f = 0; f < in_sight.size(); ++f) {
      if (!in_sight[f]) continue;
      const Face<D>& face = side.mesh.boundary[f];
      Point<D> normal = area_normal(side.mesh, face);
      normalise(normal);
      for (const Index v : face.vertices) (*out)[side.mesh.points[v]].push_back(normal);
    }
    return out;
  }

  Selection faces(const Found& pair, int which, const std::string& origin) {
    const Scene::Body& body = *sides_[which == 0 ? pair.first : pair.second].body;
    const Scene::Body& other = *sides_[which == 0 ? pair.second : pair.first].body;
    return {{},
            Field([corners = picked(pair, which), mirrors = scene_.symmetry.planes](
                      const Site& site) { return holds(*corners, mirrors, site) ? 1.0 : 0.0; },
                  fmt::format("{} in front of {}", body.name, other.name), "", true, false),
            origin};
  }

  /// Whether a vertex with that normal is one of a face that is picked, or the image of one. On a plane of symmetry it
  /// is its own image, and has the normals of both.
  static bool holds(const Corners& picked, const std::vector<Mirror>& mirrors, const Site& site) {
    std::vector<std::pair<Point<D>, Point<D>>> images(1);
    std::copy_n(site.x, D, images.front().first.begin());
    std::copy_n(site.n, D, images.front().second.begin());
    for (const Mirror& mirror : mirrors)
      for (std::size_t k = images.size(); k-- > 0;)
        images.emplace_back(reflected<D>(mirror, images[k].first), reflected_direction<D>(mirror, images[k].second));
    return std::ranges::any_of(images, [&](const auto& image) {
      const auto at = picked.find(image.first);
      return at != picked.end() && std::ranges::any_of(at->second, [&](const Point<D>& n) {
               return dot(n, image.second) > 1 - rounding_of_bases;
             });
    });
  }

  [[noreturn]] void refuse_none() const {
    const Scene::Source& source = contact_.source;
    input_error(source.of(source.given("reach") ? "reach" : "between"),
                std::isfinite(nearest_)
                    ? fmt::format("no two of the bodies have surfaces within reach in front of each other: the nearest "
                                  "are {:.4g} apart; expected a larger 'reach', or no table [contact]",
                                  nearest_)
                    : "an [[obstacle]] is between any two of the bodies; expected no table [contact]");
  }

  const Scene& scene_;
  const Scene::Contact contact_;
  std::vector<BodySide<D>> sides_;
  std::vector<Found> found_;
  double nearest_ = infinity;
};

}  // namespace

std::vector<FoundPair> add_found_pairs(Scene& scene) {
  if (!scene.contact) return {};
  Scene out = scene;
  out.dimension = dimension_of(scene);
  const std::vector<FoundPair> found = out.dimension == 2 ? Finder<2>(scene).add_to(out) : Finder<3>(scene).add_to(out);
  out.dimension = scene.dimension;
  out.contact.reset();
  check_scene(out, scene.file.string());
  scene = std::move(out);
  return found;
}

}  // namespace signorini
