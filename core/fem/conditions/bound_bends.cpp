#include "core/fem/conditions/bound_bends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"

namespace signorini {
namespace {

constexpr std::size_t edges_per_call = 2048;  // of a plugin
constexpr double no_bend = 1e-13;             // of bounds whose differences are taken

struct Interval {
  double lower, upper;
};

double bend(double a, double middle, double b) { return a - 2 * middle + b; }

/// Of an edge, as far as its parts agree, which are known up to `doubt`.
double limited(double whole, std::array<double, 3> parts, double doubt) {
  for (double& part : parts)
    if (std::isfinite(part)) part += std::clamp(whole - part, -doubt, doubt);
  double size = std::fabs(whole);
  for (const double part : parts) {
    if (!std::isfinite(part) || whole * part <= 0) return 0;
    size = std::min(size, 2 * std::fabs(part));
  }
  return std::copysign(size, whole);
}

template <int D, int B>
class EdgeBends {
 public:
  EdgeBends(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Bound<B>>& bounds)
      : nodes_(nodes), model_(model), bounds_(bounds), out_(bounds.size()) {}

  std::vector<BoundBend> run() {
    for (std::size_t obstacle = 0; obstacle < model_.obstacles.size(); ++obstacle) of(static_cast<Index>(obstacle));
    return std::move(out_);
  }

 private:
  /// Bounds along the midpoint's direction, without gaps between bodies, which are coefficients already.
  struct Edge {
    std::size_t bound;  // of the midpoint
    Interval a, middle, b;
  };

  void of(Index obstacle) {
    find_normals(obstacle);
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      if (bounds_[k].obstacle != obstacle) continue;
      if (const auto edge = edge_of(k)) add(*edge);
      if (edges_.size() == edges_per_call) limit(obstacle);
    }
    limit(obstacle);
  }

  std::optional<Edge> edge_of(std::size_t k) const {
    const Bound<B>& bound = bounds_[k];
    const auto [a, b] = nodes_.ends(bound.vertex);
    if (a == b) return {};
    const Bound<B>*at_a = twin(bound, a), *at_b = twin(bound, b);
    if (!at_a || !at_b) return {};
    return Edge{k, along(*at_a, bound), along(bound, bound), along(*at_b, bound)};
  }

  /// Of the same obstacle, along nearly the same direction, at a corner.
  const Bound<B>* twin(const Bound<B>& bound, Index corner) const {
    auto at = std::ranges::lower_bound(bounds_, corner, {}, &Bound<B>::vertex);
    for (; at != bounds_.end() && at->vertex == corner; ++at)
      if (at->obstacle == bound.obstacle && dot(at->direction, bound.direction) > smooth_cosine) return &*at;
    return nullptr;
  }

  /// What presses on another node moves it along its own direction, which on curved obstacles is another than here.
  static Interval along(const Bound<B>& other, const Bound<B>& bound) {
    const double cosine = dot(other.direction, bound.direction);
    return {cosine * (other.lower - other.gap), cosine * (other.upper - other.gap)};
  }

  /// An edge whose bounds bend at all, which they do by what all three of them say until it is limited.
  void add(const Edge& edge) {
    BoundBend& out = out_[edge.bound];
    out = {bend_of(edge, &Interval::lower), bend_of(edge, &Interval::upper)};
    if (out.lower == 0 && out.upper == 0) return;
    edges_.push_back(edge);
    const Index m = bounds_[edge.bound].vertex;
    for (const Index end : nodes_.ends(m)) places_.push_back(halfway(m, end));
  }

  static double bend_of(const Edge& edge, double Interval::*side) {
    const double a = edge.a.*side, middle = edge.middle.*side, b = edge.b.*side, bends = bend(a, middle, b);
    if (!std::isfinite(bends)) return 0;
    return std::fabs(bends) > no_bend * (std::fabs(a) + std::fabs(middle) + std::fabs(b)) ? bends : 0;
  }

  /// On the edge, which may be curved.
  SurfaceVertex halfway(Index m, Index end) const {
    SurfaceVertex out{};
    const auto [a, b] = nodes_.ends(m);
    const Point<D>&middle = nodes_.at(m), &near = nodes_.at(end), &far = nodes_.at(end == a ? b : a);
    for (int i = 0; i < D; ++i) out.position[i] = 0.75 * middle[i] + 0.375 * near[i] - 0.125 * far[i];
    Point<D> normal;
    for (int i = 0; i < D; ++i) normal[i] = normal_[m][i] + normal_[end][i];
    normalise(normal);
    std::ranges::copy(normal, out.normal);
    return out;
  }

  /// How far a parabola may be off the curve that its three nodes are on, and halfway() with it: of a circle a fifth of
  /// this.
  double off_curve(Index m) const {
    const auto [a, b] = nodes_.ends(m);
    const Point<D>& end = nodes_.at(a);
    const Point<D> middle = midpoint<D>(end, nodes_.at(b));
    const double bulge = length<D>(difference<D>(nodes_.at(m), middle)), half = length<D>(difference<D>(end, middle));
    return half > 0 ? bulge * bulge * bulge / (half * half) : 0;
  }

  void find_normals(Index obstacle) {
    const ObstacleTerm<B>& term = model_.obstacles[obstacle];
    const Surface<D> surface = term.on ? signorini::surface(nodes_, select_faces(nodes_.mesh(), *term.on, model_.t))
                                       : signorini::surface(nodes_);
    const std::vector<Point<D>> normals = node_normals(nodes_, surface);
    normal_.assign(static_cast<std::size_t>(nodes_.size()), {});
    for (std::size_t k = 0; k < normals.size(); ++k) normal_[surface.nodes[k]] = normals[k];
  }

  void limit(Index obstacle) {
    const ObstacleTerm<B>& term = model_.obstacles[obstacle];
    for (std::size_t k = 0; k < places_.size(); ++k) {
      move<D>(term, places_[k]);
      if (term.other) std::ranges::copy(bounds_[edges_[k / 2].bound].direction, places_[k].away);
    }
    if (!limit(*term.obstacle, 0, edges_.size()))  // then it fails at some of them
      for (std::size_t k = 0; k < edges_.size(); ++k)
        if (!limit(*term.obstacle, k, k + 1)) out_[edges_[k].bound] = {};
    edges_.clear();
    places_.clear();
  }

  /// The edges from `first` to `last`. @return false where the obstacle says nothing of one of them
  bool limit(const Obstacle<B>& obstacle, std::size_t first, std::size_t last) {
    std::vector<LocalConstraint<B>> constraints(2 * (last - first));
    Status status;
    obstacle.assemble(places_.data() + 2 * first, constraints.size(), constraints.data(), status);
    for (std::size_t k = first; status.ok() && k < last; ++k) {
      const std::size_t at = 2 * (k - first);
      limit(edges_[k], between(constraints[at], edges_[k]), between(constraints[at + 1], edges_[k]));
    }
    return status.ok();
  }

  Interval between(const LocalConstraint<B>& constraint, const Edge& edge) const {
    const Bound<B>& bound = bounds_[edge.bound];
    for (int k = 0; k < constraint.directions; ++k) {
      double cosine = 0;
      for (int i = 0; i < B; ++i) cosine += constraint.direction[k][i] * bound.direction[i];
      if (cosine > smooth_cosine)
        return {cosine * bound.part * constraint.lower[k], cosine * bound.part * constraint.upper[k]};
    }
    return {-infinity, infinity};
  }

  /// Both halves of the edge, and what is between their middles. What is half as long bends by a quarter.
  void limit(const Edge& edge, const Interval& near_a, const Interval& near_b) {
    const double doubt = 8 * off_curve(bounds_[edge.bound].vertex);
    const auto limited_to = [&](double whole, double Interval::*side) {
      const double a = edge.a.*side, p = near_a.*side, m = edge.middle.*side, q = near_b.*side, b = edge.b.*side;
      return limited(whole, {4 * bend(a, p, m), 4 * bend(p, m, q), 4 * bend(m, q, b)}, doubt);
    };
    BoundBend& out = out_[edge.bound];
    out = {limited_to(out.lower, &Interval::lower), limited_to(out.upper, &Interval::upper)};
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const std::vector<Bound<B>>& bounds_;
  std::vector<BoundBend> out_;         // per bound
  std::vector<Point<D>> normal_;       // per node: of the obstacle's faces
  std::vector<Edge> edges_;            // to be limited
  std::vector<SurfaceVertex> places_;  // two per edge
};

}  // namespace

template <int D, int B>
std::vector<BoundBend> bound_bends(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Bound<B>>& bounds) {
  return EdgeBends<D, B>(nodes, model, bounds).run();
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template std::vector<BoundBend> bound_bends(const Nodes<D>&, const Model<B>&, const std::vector<Bound<B>>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
