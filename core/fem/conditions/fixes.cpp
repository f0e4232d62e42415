#include "core/fem/conditions/fixes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/base/error.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/mesh/mirror.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

constexpr double same_value = 1e-9;  // difference below which two values are one, relative to the largest prescribed

// One normal per group of faces that meet smoothly at a vertex.
template <int D>
std::vector<Point<D>> group_normals(const Mesh<D>& mesh, const Point<D>& x, const Index* faces, std::size_t count) {
  std::vector<Point<D>> area(count), unit(count);
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = area[i] = area_normal(mesh, mesh.boundary[faces[i]]);
    normalise(unit[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Index curve = mesh.boundary[faces[i]].curve;
      const bool smooth =
          (curve >= 0 && curve == mesh.boundary[faces[j]].curve) || dot(unit[i], unit[j]) > smooth_cosine;
      if (smooth) std::replace(group.begin(), group.begin() + i + 1, std::size_t{group[i]}, std::size_t{group[j]});
    }
  }
  std::vector<Point<D>> normals;
  for (std::size_t g = 0; g < count; ++g) {
    Point<D> sum{};
    for (std::size_t i = 0; i < count; ++i)
      if (group[i] == g)
        for (int k = 0; k < D; ++k) sum[k] += area[i][k];
    keep_within<D>(mesh.mirrors, x, sum);
    if (normalise(sum) > 0) normals.push_back(sum);
  }
  return normals;
}

/// Collects the conditions of all fixes and their conflicts.
template <int D, int B>
class FixCollector {
 public:
  FixCollector(const Nodes<D>& nodes, const Model<B>& model)
      : nodes_(nodes), mesh_(nodes.mesh()), t_(model.t), slot_(static_cast<std::size_t>(nodes.size()), -1) {
    // What is prescribed first stays, hence backwards.
    if constexpr (B == D) {
      if (model.plane == Plane::axisymmetric) add_plane({.axis = 0, .at = 0});
      for (const Mirror& mirror : mesh_.mirrors) add_plane(mirror);
    }
    for (auto number = static_cast<Index>(model.fixes.size()) - 1; number >= 0; --number)
      add_fix(model.fixes[number], number);
    for (const Doubt& doubt : doubts_)
      if (doubt.later < 0 && doubt.by > same_value * largest_)
        refuse_on_plane(model.fixes[doubt.earlier], doubt, model.plane);
  }

  std::vector<FixedDirections<B>> fixes;

  std::vector<FixConflict> conflicts() const {
    std::map<std::pair<Index, Index>, std::set<Index>> vertices;
    for (const Doubt& doubt : doubts_)
      if (doubt.later >= 0 && doubt.by > same_value * largest_)
        vertices[{doubt.earlier, doubt.later}].insert(doubt.vertex);
    std::vector<FixConflict> result;
    result.reserve(vertices.size());
    for (const auto& [fixes_of, where] : vertices)
      result.push_back({fixes_of.first, fixes_of.second, static_cast<Index>(where.size())});
    return result;
  }

 private:
  struct Doubt {
    Index earlier, later, vertex;
    double by;
  };

  FixedDirections<B>& at(Index p) {
    if (slot_[p] < 0) {
      slot_[p] = static_cast<Index>(fixes.size());
      fixes.push_back({.vertex = p});
    }
    return fixes[slot_[p]];
  }

  void add_plane(const Mirror& mirror) {
    double across[B] = {};
    across[mirror.axis] = 1;
    for (Index p = 0; p < nodes_.size(); ++p)
      if (lies_on<D>(mirror, nodes_.at(p))) at(p).add(across, 0, -1);
  }

  [[noreturn]] void refuse_on_plane(const Fix<B>& fix, const Doubt& doubt, Plane plane) const {
    const Point<D>& x = nodes_.at(doubt.vertex);
    const bool axis = plane == Plane::axisymmetric && x[0] == 0;
    input_error(fix.on.origin,
                fmt::format("prescribes a {} displacement that is {} off at ({}), on {}, where it is zero; "
                            "expected 0 or \"free\" there",
                            axis ? "radial" : "normal", doubt.by, fmt::join(x, ", "),
                            axis ? "the axis of an axisymmetric body" : "a plane of symmetry"));
  }

  void add_fix(const Fix<B>& fix, Index number) {
    if (!fix.on.picks_faces()) {
      for (const Index p : select_nodes(nodes_, fix.on, t_)) {
        at(p);
        add_at(fix, number, p, {});
      }
      return;
    }
    const Surface<D> picked = surface(nodes_, select_faces(mesh_, fix.on, t_));
    const std::vector<Point<D>> normals = node_normals(nodes_, picked);
    for (std::size_t v = 0; v < picked.nodes.size(); ++v) {
      const Index p = picked.nodes[v];
      at(p);
      if constexpr (B == D)
        if (fix.frame.kind == Frame::normal) {
          const Index* faces = picked.around.data() + picked.first[v];
          for (const Point<D>& n : group_normals<D>(mesh_, nodes_.at(p), faces, picked.first[v + 1] - picked.first[v]))
            add_along(directions<D, B>(fix.frame, nodes_.at(p), n), fix, number, p, n);
          continue;
        }
      add_at(fix, number, p, normals[v]);
    }
  }

  void add_at(const Fix<B>& fix, Index number, Index p, const Point<D>& normal) {
    if (fix.frame.kind == Frame::cylindrical) return add_cylindrical(fix, number, p, normal);
    add_along(directions<D, B>(fix.frame, nodes_.at(p), normal), fix, number, p, normal);
  }

  /// In directions that are the same at the ends of the node's edge.
  void add_along(const std::array<std::array<double, B>, B>& direction, const Fix<B>& fix, Index number, Index p,
                 const Point<D>& normal) {
    for (int i = 0; i < B; ++i) {
      if (!fix.value[i]) continue;
      const auto value = [&](Index q) { return (*fix.value[i])(site<D>(nodes_.at(q), t_, normal)); };
      add(nodes_.coefficient(p, value), number, p, direction[i].data());
    }
  }

  /// The directions turn from node to node: the coefficient is that of the vectors that are prescribed. On the axis
  /// nothing but zero is a displacement away from it or around it, and then it does not move across itself.
  void add_cylindrical(const Fix<B>& fix, Index number, Index p, const Point<D>& normal) {
    const auto vector_at = [&](Index q) {
      std::array<double, B> out{};
      const auto direction = directions<D, B>(fix.frame, nodes_.at(q), {});
      for (int k = 0; k < B; ++k) {
        if (!fix.value[k]) continue;
        const double value = (*fix.value[k])(site<D>(nodes_.at(q), t_, normal));
        if (k < 2 && value != 0 && is_on_axis<D, B>(fix.frame, nodes_.at(q))) refuse_on_axis(fix, q, k, value);
        for (int i = 0; i < B; ++i) out[i] += value * direction[k][i];
      }
      return out;
    };
    std::array<double, B> u{};
    for (int i = 0; i < B; ++i) u[i] = nodes_.coefficient(p, [&](Index q) { return vector_at(q)[i]; });
    const auto direction = directions<D, B>(fix.frame, nodes_.at(p), {});
    const bool on_axis = is_on_axis<D, B>(fix.frame, nodes_.at(p));
    for (int k = 0; k < B; ++k) {
      const bool across = B > 1 && k < 2 && on_axis && (fix.value[0] || fix.value[B > 1]);
      if (fix.value[k] || across) add(block::dot<B>(direction[k].data(), u.data()), number, p, direction[k].data());
    }
  }

  [[noreturn]] void refuse_on_axis(const Fix<B>& fix, Index p, int component, double value) const {
    input_error(fix.on.origin,
                fmt::format("prescribes a displacement of {} {} the axis at ({}), which is on it; expected "
                            "0 there, or faces off the axis",
                            value, component == 0 ? "away from" : "around", fmt::join(nodes_.at(p), ", ")));
  }

  void add(double v0, Index number, Index p, const double* direction) {
    largest_ = std::max(largest_, std::fabs(v0));
    const auto found = fixes[slot_[p]].add(direction, v0, number);
    if (found.by > 0 && found.fix != number) doubts_.push_back({number, found.fix, p, found.by});
  }

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  double t_;
  std::vector<Index> slot_;
  std::vector<Doubt> doubts_;  // differences, some of them by rounding only
  double largest_ = 0;
};

}  // namespace

template <int D, int B>
std::vector<FixedDirections<B>> collect_fixes(const Nodes<D>& nodes, const Model<B>& model) {
  if (model.fixes.empty() && model.plane != Plane::axisymmetric && nodes.mesh().mirrors.empty()) return {};
  std::vector<FixedDirections<B>> fixes = FixCollector<D, B>(nodes, model).fixes;
  std::erase_if(fixes, [](const auto& f) { return f.count == 0; });
  std::sort(fixes.begin(), fixes.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return fixes;
}

template <int D, int B>
std::vector<FixConflict> fix_conflicts(const Nodes<D>& nodes, const Model<B>& model) {
  return FixCollector<D, B>(nodes, model).conflicts();
}

#define SIGNORINI_INSTANTIATE(D, B)                                                         \
  template std::vector<FixedDirections<B>> collect_fixes(const Nodes<D>&, const Model<B>&); \
  template std::vector<FixConflict> fix_conflicts(const Nodes<D>&, const Model<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
