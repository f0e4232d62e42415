#include "core/fem/recovery/between_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/pairs/paired_sides.hpp"

namespace signorini {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

/// Calls use(barycentric) with the points whose coordinates are multiples of 1/(2 P), but for the nodes.
template <int K, int P, class Use>
void each_point_between(const Use& use) {
  constexpr int parts = 2 * P;
  std::array<int, K + 1> at{};
  at[0] = parts;
  const auto next = [&] {  // the one after it in lexical order, if any
    int k = K - 1;
    while (k >= 0 && at[k] == 0) --k;
    if (k < 0) return false;
    const int rest = at[K] + 1;
    --at[k];
    at[K] = 0;
    at[k + 1] = rest;
    return true;
  };
  do {
    if (std::ranges::all_of(at, [](int part) { return part % 2 == 0; })) continue;  // a node
    std::array<double, K + 1> barycentric;
    std::ranges::transform(at, barycentric.begin(), [](int part) { return static_cast<double>(part) / parts; });
    use(barycentric);
  } while (next());
}

template <int B>
double violation(const LocalConstraint<B>& constraint, const std::array<double, B>& value) {
  double worst = 0;
  for (int k = 0; k < constraint.directions; ++k) {
    double along = 0;
    for (int i = 0; i < B; ++i) along += constraint.direction[k][i] * value[i];
    worst = std::max({worst, constraint.lower[k] - along, along - constraint.upper[k]});
  }
  return worst;
}

/// The points to be asked, and what a scalar unknown is there; displacements are counted in the positions.
template <int D, int B>
class Points {
 public:
  Points(const Nodes<D>& nodes, Index obstacle, const ContactState<B>& state, const std::vector<double>& u)
      : nodes_(nodes), u_(u), gap_(nodes.size(), infinity), displaced_(nodes.mesh().points) {
    for (const ContactNode<B>& node : state.nodes)  // that of a nearer obstacle is less than this one's
      if (B > 1 || (node.contact && node.obstacle == obstacle))
        gap_[node.vertex] = std::min(gap_[node.vertex], node.contact ? 0 : node.gap);
    if (B == 1) return;
    const std::vector<double> by = nodes.at_vertices(u, B);
    for (std::size_t v = 0; v < displaced_.size(); ++v)
      for (int i = 0; i < B; ++i) displaced_[v][i] += by[v * B + i];
  }

  template <int P, int K>
  void add(const std::array<Index, element_nodes<K, P>>& vertices) {
    const auto node = nodes_.of(vertices);
    if (!is_near<K>(node)) return;
    const ElementMap<D, K, P> map(displaced_, vertices);
    each_point_between<K, P>([&](const std::array<double, K + 1>& barycentric) {
      SurfaceVertex& point = vertices_.emplace_back();
      std::ranges::copy(map(barycentric), point.position);
      if constexpr (K == D - 1) {
        Point<D> normal = area_normal(map.flat(barycentric));
        normalise(normal);
        std::ranges::copy(normal, point.normal);
      }
      std::array<double, B>& value = value_.emplace_back();
      if constexpr (B == 1) {
        const auto basis_value = basis<P>(barycentric);
        for (std::size_t a = 0; a < node.size(); ++a) value[0] += basis_value[a] * u_[node[a]];
      }
    });
  }

  double largest_violation(const Obstacle<B>& obstacle) const {
    std::vector<LocalConstraint<B>> constraints(vertices_.size());
    Status status;
    obstacle.assemble(vertices_.data(), vertices_.size(), constraints.data(), status);
    if (!status.ok()) return unmeasured;
    double worst = 0;
    for (std::size_t k = 0; k < constraints.size(); ++k)
      worst = std::max(worst, violation<B>(constraints[k], value_[k]));
    return worst;
  }

 private:
  /// Distances change by no more than the way: what is farther off than its corners are from each other is clear.
  template <int K, std::size_t N>
  bool is_near(const std::array<Index, N>& node) const {
    double least = infinity, longest = 0;
    for (const Index p : node) least = std::min(least, gap_[p]);
    for (int k = 0; k <= K; ++k)
      for (int m = 0; m < k; ++m)
        longest = std::max(longest, length<D>(difference<D>(nodes_.at(node[k]), nodes_.at(node[m]))));
    return least <= longest;
  }

  const Nodes<D>& nodes_;
  const std::vector<double>& u_;
  std::vector<double> gap_;  // per node
  std::vector<Point<D>> displaced_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<std::array<double, B>> value_;
};

}  // namespace

template <int D, int B>
double violation_between_nodes(const Nodes<D>& nodes, const Model<B>& model, Index obstacle,
                               const ContactState<B>& state, const std::vector<double>& u) {
  const ObstacleTerm<B>& term = model.obstacles[obstacle];
  if constexpr (B == D)
    if (term.other) return std::max(couple_displaced(nodes, model, obstacle, u).deepest.depth - term.adjust, 0.0);
  const bool in_body = B == 1 && !term.on;
  if ((B > 1 && !term.shape) || (in_body && nodes.order() == 1)) return unmeasured;
  Points<D, B> points(nodes, obstacle, state, u);
  with_order(nodes, [&](auto order) {
    if (in_body) {
      for (const auto& element : nodes.template elements<order>()) points.template add<order, D>(element);
      return;
    }
    const std::vector<Index> faces = term.on ? select_faces(nodes.mesh(), *term.on, model.t) : surface(nodes).faces;
    for (const Index face : faces)
      if (face % nodes.faces_per_element() == 0)
        points.template add<order, D - 1>(nodes.template element_face<order>(face));
  });
  return points.largest_violation(*term.obstacle);
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                        \
  template double violation_between_nodes(const Nodes<D>&, const Model<B>&, Index, const ContactState<B>&, \
                                          const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
