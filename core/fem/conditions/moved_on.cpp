#include "core/fem/conditions/moved_on.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/elements/symmetric_motion.hpp"

namespace signorini {
namespace {

constexpr double touching = 1e-6;     // of how far nodes have come along their normals: what tolerances leave
constexpr double noticeable = 0.002;  // of what contact flattens
constexpr double better = 0.5;        // of the error before: where each node has a way of its own the mean is no better

/// What is left of a bound.
template <int D>
double left_of(const Bound<D>& bound, const std::vector<double>& u) {
  double along = 0;
  for (int i = 0; i < D; ++i) along += bound.direction[i] * u[Offset{bound.vertex} * D + i];
  return std::min(along - bound.lower, bound.upper - along);
}

/// Nodes that touch a rigid obstacle in a solution, or the nearest one; where nothing touches, but the obstacle is
/// reached all the same, those that are inside it.
template <int D>
class Touching {
 public:
  Touching(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, const std::vector<double>& u)
      : nodes_(nodes),
        model_(model),
        obstacle_(obstacle),
        u_(u),
        faces_(term().on ? surface(nodes, select_faces(nodes.mesh(), *term().on, model.t)) : surface(nodes)),
        distance_(distances()) {
    const std::vector<Bound<D>> bounds = bounds_of(nodes, model, obstacle);
    double nearest = infinity, closed = 0;
    for (const Bound<D>& bound : bounds) {
      closed = std::max(closed, std::fabs(along(bound.direction, displacement(bound.vertex))));
      nearest = std::min(nearest, left_of(bound, u));
    }
    const double rounding = touching * closed, reach = std::max(nearest, 0.0) + rounding;
    const auto is_inside = [&](Index p) { return distance(p) < -rounding; };
    const bool penetrates = std::ranges::any_of(bounds, is_inside, &Bound<D>::vertex);
    for (const Bound<D>& bound : bounds) {
      const Index p = bound.vertex;
      const bool near = left_of(bound, u) <= reach;
      if (nearest > rounding && penetrates ? is_inside(p) : near) bounds_.push_back(bound);
      if (near || is_inside(p)) corners_.insert(corners_.end(), {nodes.ends(p)[0], nodes.ends(p)[1]});
    }
    std::ranges::sort(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  }

  bool none() const { return bounds_.empty(); }

  Point<D> mean() const {
    Point<D> out{};
    for (const Bound<D>& bound : bounds_)
      for (int i = 0; i < D; ++i) out[i] += displacement(bound.vertex)[i] / static_cast<double>(bounds_.size());
    return symmetric_motion<D>(nodes_.mesh(), model_.plane, out);
  }

  /// By how much more some of them have come along their normals than others, but for a motion of all of them.
  double flattened(const Point<D>& motion) const {
    double least = infinity, most = -infinity;
    for (const Bound<D>& bound : bounds_) {
      const double by = along(bound.direction, difference<D>(displacement(bound.vertex), motion));
      least = std::min(least, by);
      most = std::max(most, by);
    }
    return most - least;
  }

  double size() const {
    double out = 0;
    for (const Bound<D>& bound : bounds_)
      for (int i = 0; i < D; ++i)
        out = std::max(out, std::fabs(nodes_.at(bound.vertex)[i]) + std::fabs(displacement(bound.vertex)[i]));
    return out;
  }

  /// How far conditions that are linear about a motion of all are from the true distances, at the corners of elements
  /// next to them: there coefficients are displacements.
  double error_about(const Point<D>& motion) const {
    Model<D> there = model_;
    there.obstacles[obstacle_].moved = motion;
    const std::vector<Bound<D>> linear = bounds_of(nodes_, there, obstacle_);
    double out = 0;
    for (const Index p : corners_) {
      double left = infinity;
      for (auto at = std::ranges::lower_bound(linear, p, {}, &Bound<D>::vertex); at != linear.end() && at->vertex == p;
           ++at)
        left = std::min(left, left_of(*at, u_));
      const double there_is = distance(p);
      if (std::isfinite(there_is) && std::isfinite(left)) out = std::max(out, std::fabs(there_is - left));
    }
    return out;
  }

 private:
  const ObstacleTerm<D>& term() const { return model_.obstacles[obstacle_]; }

  Point<D> displacement(Index p) const {
    Point<D> out;
    std::copy_n(u_.data() + Offset{p} * D, D, out.begin());
    return out;
  }

  static double along(const std::array<double, D>& direction, const Point<D>& by) { return dot(direction, by); }

  /// Of where a node is; infinite between corners, and where the obstacle cannot tell.
  double distance(Index p) const {
    const auto at = std::ranges::lower_bound(faces_.nodes, p);
    const bool known = at != faces_.nodes.end() && *at == p && nodes_.ends(p)[0] == nodes_.ends(p)[1];
    return known ? distance_[static_cast<std::size_t>(at - faces_.nodes.begin())] : infinity;
  }

  std::vector<double> distances() const {
    const std::vector<Point<D>> normals = node_normals(nodes_, faces_);
    std::vector<SurfaceVertex> vertices(normals.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Index p = faces_.nodes[v];
      for (int i = 0; i < D; ++i) vertices[v].position[i] = nodes_.at(p)[i] + displacement(p)[i];
      std::copy_n(normals[v].data(), D, vertices[v].normal);
    }
    std::vector<LocalConstraint<D>> constraints(vertices.size());
    Status status;
    term().obstacle->assemble(vertices.data(), vertices.size(), constraints.data(), status);
    std::vector<double> out(vertices.size(), infinity);
    for (std::size_t v = 0; v < out.size() && status.ok(); ++v)
      for (int k = 0; k < constraints[v].directions; ++k)
        out[v] = std::min({out[v], -constraints[v].lower[k], constraints[v].upper[k]});
    return out;
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const Index obstacle_;
  const std::vector<double>& u_;
  const Surface<D> faces_;
  const std::vector<double> distance_;  // per node of the faces
  std::vector<Bound<D>> bounds_;
  std::vector<Index> corners_;  // ascending
};

}  // namespace

template <int D>
std::optional<Point<D>> moved_on(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                 const std::vector<double>& u) {
  const Touching<D> touch(nodes, model, obstacle, u);
  if (touch.none()) return {};
  const Point<D> mean = touch.mean();
  const double error = touch.error_about(model.obstacles[obstacle].moved);
  if (!(error > std::max(noticeable * touch.flattened(mean), rounding_of_differences * touch.size()))) return {};
  if (!(touch.error_about(mean) < better * error)) return {};
  return mean;
}

template std::optional<Point<2>> moved_on<2>(const Nodes<2>&, const Model<2>&, Index, const std::vector<double>&);
template std::optional<Point<3>> moved_on<3>(const Nodes<3>&, const Model<3>&, Index, const std::vector<double>&);

}  // namespace signorini
