#include "driver/warnings/unheld_overlaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/fem/pairs/overlap.hpp"
#include "core/io/warning_kinds.hpp"

namespace signorini {
namespace {

constexpr double of_motion = 1e-3;  // the least overlap beside the largest displacement

bool is_kept_apart(const Scene& scene, const std::string& a, const std::string& b) {
  return std::ranges::any_of(scene.obstacles, [&](const Scene::Obstacle& obstacle) {
    return std::minmax(obstacle.body, obstacle.other) == std::minmax(a, b);
  });
}

template <int D>
double largest_displacement(const MovedBoundaries<D>& all) {
  double out = 0;
  for (std::size_t p = 0; p < all.after.size(); ++p)
    for (int i = 0; i < D; ++i) out = std::max(out, std::fabs(all.after[p][i] - all.mesh.points[p][i]));
  return out;
}

}  // namespace

template <int D>
void MovedBoundaries<D>::add(const Mesh<D>& of, const std::string& name, const std::vector<Index>& faces_of_body,
                             const std::vector<double>& u) {
  body.push_back(name);
  std::vector<Index>& numbers = faces.emplace_back();
  std::map<Index, Index> number;
  for (const Index f : faces_of_body) {
    Face<D> face = of.boundary[f];
    for (Index& v : face.vertices) {
      const auto [at, is_new] = number.try_emplace(v, mesh.vertices());
      if (is_new) {
        mesh.points.push_back(of.points[v]);
        Point<D>& x = after.emplace_back(of.points[v]);
        for (int i = 0; i < D; ++i) x[i] += u[Offset{v} * D + i];
      }
      v = at->second;
    }
    numbers.push_back(static_cast<Index>(mesh.boundary.size()));
    mesh.boundary.push_back(face);
  }
}

template <int D>
Warnings unheld_overlaps(const Scene& scene, const MovedBoundaries<D>& all) {
  Warnings out;
  const double moved = largest_displacement(all);
  for (std::size_t a = 0; a < all.body.size(); ++a)
    for (std::size_t b = a + 1; b < all.body.size(); ++b) {
      if (is_kept_apart(scene, all.body[a], all.body[b])) continue;
      const auto overlap = [&](const std::vector<Point<D>>& points) {
        return find_overlap<D>(all.mesh, points, {all.faces[a], all.faces[a]}, {all.faces[b], all.faces[b]});
      };
      const Overlap<D> now = overlap(all.after);
      if (!(now.depth > of_motion * moved) || overlap(all.mesh.points).depth > now.depth / 2) continue;
      out.push_back(warning<"unheld-overlap">(all.body[a], all.body[b], now.depth, fmt::join(now.place, ", ")));
    }
  return out;
}

#define SIGNORINI_INSTANTIATE(D)      \
  template struct MovedBoundaries<D>; \
  template Warnings unheld_overlaps(const Scene&, const MovedBoundaries<D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
