#include "core/fem/conditions/walls.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"

namespace signorini {
namespace {

constexpr double same_wall = 1e-6;  // of lengths and directions: vertices of files may be in single precision

template <int D>
class WallFinder {
 public:
  WallFinder(const Nodes<D>& nodes, const Model<D>& model)
      : nodes_(nodes), mesh_(nodes.mesh()), fixes_(collect_fixes<D, D>(nodes, model)), size_(extent(nodes.mesh())) {}

  std::vector<Flat<D>> beside(const std::vector<Index>& at) {
    std::vector<Flat<D>> out, refused;
    for (Index f = 0; f < static_cast<Index>(mesh_.boundary.size()); ++f) {
      const auto node = nodes_.of_face(f);
      if (mesh_.boundary[f].curve >= 0 ||
          std::ranges::none_of(node, [&](Index p) { return std::ranges::binary_search(at, p); }))
        continue;
      Flat<D> plane{nodes_.at(node[0]), area_normal(mesh_, mesh_.boundary[f])};
      normalise(plane.normal);
      const auto is_it = [&](const Flat<D>& other) { return same(plane, other); };
      if (!slides(node, plane) || std::ranges::any_of(out, is_it) || std::ranges::any_of(refused, is_it)) continue;
      (ends_all(plane) ? out : refused).push_back(plane);
    }
    return out;
  }

 private:
  bool same(const Flat<D>& a, const Flat<D>& b) const {
    return std::abs(dot(a.normal, b.normal)) > 1 - same_wall && lies_on<D>(a, b.point, size_);
  }

  bool is_held(Index p, const Point<D>& normal) const {
    const auto fixed = std::ranges::lower_bound(fixes_, p, {}, &FixedDirections<D>::vertex);
    if (fixed == fixes_.end() || fixed->vertex != p) return false;
    double square = 0, by = 0;
    for (int k = 0; k < fixed->count; ++k) {
      double along = 0;
      for (int i = 0; i < D; ++i) along += fixed->direction[k][i] * normal[i];
      square += along * along;
      by += along * fixed->value[k];
    }
    return square > 1 - same_wall && by == 0;
  }

  /// Whether nodes of a face stay on its plane, and some are free to move along it.
  bool slides(const std::array<Index, D>& node, const Flat<D>& plane) const {
    bool any = false;
    for (const Index p : node) {
      if (!is_held(p, plane.normal)) return false;
      any = any || std::ranges::lower_bound(fixes_, p, {}, &FixedDirections<D>::vertex)->count == 1;
    }
    return any;
  }

  /// Whether the plane ends all bodies, and holds them everywhere.
  bool ends_all(const Flat<D>& plane) const {
    for (const Point<D>& x : mesh_.points)
      if (dot(difference<D>(x, plane.point), plane.normal) > same_wall * size_) return false;
    for (Index f = 0; f < static_cast<Index>(mesh_.boundary.size()); ++f) {
      const auto node = nodes_.of_face(f);
      if (std::ranges::all_of(node, [&](Index p) { return lies_on<D>(plane, nodes_.at(p), size_); }) &&
          !std::ranges::all_of(node, [&](Index p) { return is_held(p, plane.normal); }))
        return false;
    }
    return true;
  }

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  const std::vector<FixedDirections<D>> fixes_;
  const double size_;
};

}  // namespace

template <int D>
double extent(const Mesh<D>& mesh) {
  double out = 0;
  for (int i = 0; i < D; ++i) {
    const auto [low, high] = std::ranges::minmax(mesh.points, {}, [i](const Point<D>& x) { return x[i]; });
    out = std::max(out, high[i] - low[i]);
  }
  return out;
}

template <int D>
bool lies_on(const Flat<D>& plane, const Point<D>& x, double extent) {
  return std::abs(dot(difference<D>(x, plane.point), plane.normal)) <= same_wall * extent;
}

template <int D>
Point<D> reflected(const Flat<D>& plane, Point<D> x) {
  const double height = dot(difference<D>(x, plane.point), plane.normal);
  for (int i = 0; i < D; ++i) x[i] -= 2 * height * plane.normal[i];
  return x;
}

template <int D, int B>
std::vector<Flat<D>> walls(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Index>& at) {
  if constexpr (B == D)
    if (!model.fixes.empty()) return WallFinder<D>(nodes, model).beside(at);
  return {};
}

#define SIGNORINI_INSTANTIATE(D)                                                                          \
  template double extent<D>(const Mesh<D>&);                                                              \
  template bool lies_on<D>(const Flat<D>&, const Point<D>&, double);                                      \
  template Point<D> reflected<D>(const Flat<D>&, Point<D>);                                               \
  template std::vector<Flat<D>> walls<D, D>(const Nodes<D>&, const Model<D>&, const std::vector<Index>&); \
  template std::vector<Flat<D>> walls<D, 1>(const Nodes<D>&, const Model<1>&, const std::vector<Index>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
