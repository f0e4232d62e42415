#include "driver/levels/approach.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "core/fem/model/obstacle_motion.hpp"
#include "core/mesh/connected.hpp"

namespace signorini {
namespace {

constexpr double noticeable = 0.05;  // of what friction may hold back
constexpr double steep = 4;          // times that: beyond it all slips
constexpr double short_time = 0.2;   // in contact, of that left of a planned step: what follows puts right
constexpr double touching = 1e-6;    // in contact: what bodies do that only just touch at the end

template <int D>
Point<D> at(const std::vector<double>& u, Index node) {
  Point<D> out;
  std::copy_n(u.data() + Offset{node} * D, D, out.begin());
  return out;
}

template <int D>
void add(double factor, const Point<D>& v, Point<D>& to) {
  for (int i = 0; i < D; ++i) to[i] += factor * v[i];
}

/// How bodies move that have no vertex in common.
template <int D>
class BodyMotions {
 public:
  BodyMotions(const Nodes<D>& nodes, Plane plane, const std::vector<Index>& body, std::vector<double> by)
      : nodes_(nodes), body_(body), by_(std::move(by)) {
    mean_.resize(static_cast<std::size_t>(*std::ranges::max_element(body)) + 1);
    std::vector<double> vertices(mean_.size());
    for (std::size_t v = 0; v < body.size(); ++v) {
      ++vertices[body[v]];
      add<D>(1, motion(static_cast<Index>(v)), mean_[body[v]]);
    }
    for (std::size_t k = 0; k < mean_.size(); ++k) {
      for (double& component : mean_[k]) component /= vertices[k];
      mean_[k] = symmetric_motion<D>(nodes.mesh(), plane, mean_[k]);
    }
  }

  /// Nothing moves where there is no body: -1.
  Point<D> mean(Index body) const { return body < 0 ? Point<D>{} : mean_[body]; }
  /// The most that a vertex of a body moves.
  double most(Index body, const Point<D>& direction) const {
    if (body < 0) return 0;
    double out = -infinity;
    for (std::size_t v = 0; v < body_.size(); ++v)
      if (body_[v] == body) out = std::max(out, dot(motion(static_cast<Index>(v)), direction));
    return out;
  }

 private:
  Point<D> motion(Index v) const { return at<D>(by_, nodes_.of_vertex(v)); }

  const Nodes<D>& nodes_;
  const std::vector<Index>& body_;  // per vertex
  const std::vector<double> by_;
  std::vector<Point<D>> mean_;
};

template <int D>
std::vector<double> difference(std::vector<double> u, const std::vector<double>& before) {
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= before[i];
  return u;
}

/// A step seen from what touches at its end.
template <int D>
class Approach {
 public:
  Approach(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& before,
           const std::vector<double>& u)
      : nodes_(nodes),
        model_(model),
        body_(connected_parts(nodes.mesh())),
        of_node_(nodes.size()),
        before_(before),
        until_(nodes, model.plane, body_, before),
        motions_(nodes, model.plane, body_, difference<D>(u, before)),
        of_(model.obstacles.size()) {
    for (std::size_t v = 0; v < body_.size(); ++v) of_node_[nodes.of_vertex(static_cast<Index>(v))] = body_[v];
  }

  void touched_before(Index obstacle) { of_[obstacle].touched = true; }
  void has_other(const ContactNode<D>& master) { of_[master.obstacle].other = body(master.vertex); }
  void add_node(const ContactNode<D>& node) {
    OfObstacle& of = of_[node.obstacle];
    of.apart = std::min(of.apart, gap_before(node, of.other));
    const double presses = node.contact ? std::max(node.pressure, 0.0) * node.area : 0;
    if (!(presses > 0)) return;
    of.body = body(node.vertex);
    const Point<D> drag = obstacle_motion_at(node);
    Point<D> way = motions_.mean(of.body);
    add<D>(-1, motions_.mean(of.other), way);
    add<D>(-1, drag, way);
    const double straight = -dot(way, node.direction);
    of.pressed += presses;
    of.limit += presses * node.law.coefficient;
    of.straight += presses * straight;
    of.along += presses * std::sqrt(std::max(dot(way, way) - straight * straight, 0.0));
    add<D>(-presses, node.direction, of.down);
    add<D>(presses, drag, of.drag);
  }

  double in_flight(Index obstacle, double rest) const {
    const OfObstacle& of = of_[obstacle];
    const double size = length<D>(of.down);
    if (of.touched || !(of.apart > 0) || !(of.limit > 0) || !(size > 0)) return 0;
    Point<D> down = of.down, up{};
    for (double& component : down) component /= size;
    add<D>(-1, down, up);
    const double nearer = motions_.most(of.body, down) + motions_.most(of.other, up) + dot(of.drag, up) / of.pressed;
    const double part = std::min(of.apart / nearer, 1.0), left = 1 - part + rest;
    const double held = of.limit / of.pressed * of.straight;
    const bool matters = part * of.along > noticeable * held * left && of.along < steep * held;
    return matters && 1 - part > std::max(short_time * left, touching) ? part : 0;
  }

 private:
  struct OfObstacle {
    Point<D> down{}, drag{};         // sums over what presses, and weighted by it, like those below
    double pressed = 0, limit = 0;   // of the latter: what friction may do
    double straight = 0, along = 0;  // ways to the surface, and along it
    double apart = infinity;         // when the step began
    bool touched = false;            // then
    Index body = -1, other = -1;
  };

  Index body(Index node) const { return of_node_[nodes_.ends(node)[0]]; }

  SurfaceVertex vertex(const ContactNode<D>& node, const Point<D>& by) const {
    SurfaceVertex out{};
    for (int i = 0; i < D; ++i) {
      out.position[i] = nodes_.at(node.vertex)[i] + by[i];
      out.normal[i] = -node.direction[i];
    }
    return out;
  }

  Point<D> obstacle_motion_at(const ContactNode<D>& node) const {
    Status status;
    const Point<D> out = obstacle_motion<D>(model_.obstacles[node.obstacle], vertex(node, {}), status);
    return status.ok() ? out : Point<D>{};
  }

  /// Rigid obstacles tell the distance; the other body, which nothing has touched, was moved as a whole.
  double gap_before(const ContactNode<D>& node, Index other) const {
    const ObstacleTerm<D>& term = model_.obstacles[node.obstacle];
    Point<D> by = at<D>(before_, node.vertex);
    if (term.shape) {
      const SurfaceVertex there = vertex(node, by);
      Status status;
      const double out =
          (term.shape_before ? term.shape_before : term.shape)->at(there.position, there.normal, status).value;
      return status.ok() ? out : infinity;
    }
    add<D>(-1, until_.mean(other), by);
    return node.start + dot(by, node.direction);
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const std::vector<Index> body_;  // per vertex
  std::vector<Index> of_node_;     // of vertices alone
  const std::vector<double>& before_;
  const BodyMotions<D> until_, motions_;  // the step, in it
  std::vector<OfObstacle> of_;
};

}  // namespace

template <int D>
double part_in_flight(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& last,
                      const ContactState<D>& now, const std::vector<ContactNode<D>>& masters,
                      const std::vector<double>& before, const std::vector<double>& u, double rest) {
  Approach<D> approach(nodes, model, before, u);
  for (const ContactNode<D>& node : last.nodes)
    if (node.contact) approach.touched_before(node.obstacle);
  for (const ContactNode<D>& node : masters)
    if (node.contact) approach.has_other(node);
  for (const ContactNode<D>& node : now.nodes) approach.add_node(node);
  double out = 0;
  for (Index k = 0; k < std::ssize(model.obstacles); ++k) out = std::max(out, approach.in_flight(k, rest));
  return out;
}

template double part_in_flight(const Nodes<2>&, const Model<2>&, const ContactState<2>&, const ContactState<2>&,
                               const std::vector<ContactNode<2>>&, const std::vector<double>&,
                               const std::vector<double>&, double);
template double part_in_flight(const Nodes<3>&, const Model<3>&, const ContactState<3>&, const ContactState<3>&,
                               const std::vector<ContactNode<3>>&, const std::vector<double>&,
                               const std::vector<double>&, double);

}  // namespace signorini
