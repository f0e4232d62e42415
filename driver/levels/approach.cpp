#include "driver/levels/approach.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "core/mesh/connected.hpp"
#include "driver/levels/turned_friction.hpp"

namespace signorini {
namespace {

constexpr double noticeable = 0.2;       // more than a coarse mesh leaves between round bodies drawn in contact
constexpr double flat = 0.1, steep = 4;  // of the way along a surface that friction may hold back

/// How bodies move that have no vertex in common.
template <int D>
class BodyMotions {
 public:
  BodyMotions(const Nodes<D>& nodes, Plane plane, const std::vector<double>& by)
      : nodes_(nodes), by_(by), body_(connected_parts(nodes.mesh())), of_node_(nodes.size()) {
    mean_.resize(static_cast<std::size_t>(*std::ranges::max_element(body_)) + 1);
    std::vector<double> vertices(mean_.size());
    for (Index v = 0; v < nodes.mesh().vertices(); ++v) {
      of_node_[nodes.of_vertex(v)] = body_[v];
      ++vertices[body_[v]];
      for (int i = 0; i < D; ++i) mean_[body_[v]][i] += motion(v)[i];
    }
    for (std::size_t k = 0; k < mean_.size(); ++k) {
      for (double& component : mean_[k]) component /= vertices[k];
      mean_[k] = symmetric_motion<D>(nodes.mesh(), plane, mean_[k]);
    }
  }

  Index body(Index node) const { return of_node_[nodes_.ends(node)[0]]; }
  const Point<D>& mean(Index body) const { return mean_[body]; }
  /// The most that a vertex of the body moves.
  double most(Index body, const Point<D>& direction) const {
    double out = -infinity;
    for (Index v = 0; v < nodes_.mesh().vertices(); ++v)
      if (body_[v] == body) out = std::max(out, dot(motion(v), direction));
    return out;
  }

 private:
  Point<D> motion(Index v) const {
    Point<D> out;
    std::copy_n(by_.data() + Offset{nodes_.of_vertex(v)} * D, D, out.begin());
    return out;
  }

  const Nodes<D>& nodes_;
  const std::vector<double>& by_;
  const std::vector<Index> body_;  // per vertex
  std::vector<Index> of_node_;     // of vertices alone
  std::vector<Point<D>> mean_;
};

/// Contact with one obstacle.
template <int D>
struct Approach {
  Point<D> normal{};              // mean of those where something presses, against the motion
  double pressed = 0, limit = 0;  // sums of what presses, and of what friction may do
  double apart = infinity;        // when the step began
  bool touched = false;           // then
  Index body = -1, other = -1;    // -1: none

  void add(const ContactNode<D>& node, double gap_before) {
    apart = std::min(apart, gap_before);
    const double presses = node.contact ? std::max(node.pressure, 0.0) * node.area : 0;
    pressed += presses;
    limit += node.law.coefficient * presses;
    for (int i = 0; i < D; ++i) normal[i] -= presses * node.direction[i];
  }

  double in_flight(const BodyMotions<D>& motions) const {
    const double size = length<D>(normal);
    if (touched || body < 0 || !(apart > 0) || !(limit > 0) || !(size > 0)) return 0;
    Point<D> down = normal, way = motions.mean(body), back{};
    for (int i = 0; i < D; ++i) down[i] /= size, back[i] = -down[i];
    if (other >= 0) way = difference<D>(way, motions.mean(other));
    const double straight = dot(way, down), held = limit / pressed * straight;
    const double along = std::sqrt(std::max(dot(way, way) - straight * straight, 0.0));
    if (!(along > flat * held && along < steep * held)) return 0;
    const double nearer = motions.most(body, down) + (other < 0 ? 0 : motions.most(other, back));
    return std::min(apart / nearer, 1.0);
  }
};

}  // namespace

template <int D>
double part_in_flight(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& last,
                      const ContactState<D>& now, const std::vector<ContactNode<D>>& masters,
                      const std::vector<double>& by, double rest) {
  const BodyMotions<D> motions(nodes, model.plane, by);
  std::vector<Approach<D>> all(now.obstacles.size());
  for (const ContactNode<D>& node : last.nodes) all[node.obstacle].touched |= node.contact;
  for (const ContactNode<D>& node : now.nodes) {
    const ContactNode<D>* before = same_node(last, node);
    all[node.obstacle].add(node, before ? before->gap : node.start);
    if (node.contact) all[node.obstacle].body = motions.body(node.vertex);
  }
  for (const ContactNode<D>& node : masters)
    if (node.contact) all[node.obstacle].other = motions.body(node.vertex);
  double out = 0;
  for (const Approach<D>& approach : all) {
    const double part = approach.in_flight(motions);
    if (std::min(part, 1 - part) > noticeable * (1 - part + rest)) out = std::max(out, part);
  }
  return out;
}

template double part_in_flight(const Nodes<2>&, const Model<2>&, const ContactState<2>&, const ContactState<2>&,
                               const std::vector<ContactNode<2>>&, const std::vector<double>&, double);
template double part_in_flight(const Nodes<3>&, const Model<3>&, const ContactState<3>&, const ContactState<3>&,
                               const std::vector<ContactNode<3>>&, const std::vector<double>&, double);

}  // namespace signorini
