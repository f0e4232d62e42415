#include "driver/levels/turned_friction.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "core/mesh/connected.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

constexpr double most = 0.5;  // of the sum of what acts at the nodes, without regard to directions

/// What an obstacle exerts along its surface at some nodes.
template <int B>
struct Drag {
  std::array<double, B> force{};
  double size = 0;

  void add(const ContactNode<B>& node) {
    for (int i = 0; i < B; ++i) force[i] += node.tangential[i];
    size += block::norm<B>(node.tangential.data());
  }
  bool has_direction() const { return block::norm<B>(force.data()) > most * size; }
};

template <int B>
const ContactNode<B>* same(const ContactState<B>& contact, const ContactNode<B>& node) {
  auto other = std::ranges::lower_bound(contact.nodes, node.vertex, {}, &ContactNode<B>::vertex);
  for (; other != contact.nodes.end() && other->vertex == node.vertex; ++other)
    if (other->obstacle == node.obstacle) return &*other;
  return nullptr;
}

/// What touches first of an obstacle: nodes as near as the nearest one is before a step, but for rounding.
class Beginning {
 public:
  /// @param gap of a node then
  void add(double gap, bool touches) {
    if (gap < least_ - std::fabs(least_) * rounding_of_differences) stays_ = false;
    if (gap <= least_ + std::fabs(least_) * rounding_of_differences) stays_ = stays_ || touches;
    least_ = std::min(least_, gap);
  }
  /// Whether one of them touches after the step.
  bool stays() const { return stays_; }

 private:
  double least_ = infinity;
  bool stays_ = false;
};

}  // namespace

template <int B>
const char* doubt_of_friction(const ContactState<B>& last, const ContactState<B>& now, bool followed) {
  std::vector<Beginning> beginning(now.obstacles.size());
  std::vector<Drag<B>> before(now.obstacles.size()), after(now.obstacles.size()), of_newcomers(now.obstacles.size());
  for (const ContactNode<B>& node : last.nodes) before[node.obstacle].add(node);
  for (const ContactNode<B>& node : now.nodes) {
    after[node.obstacle].add(node);
    const ContactNode<B>* before = same(last, node);
    if (!std::isnan(node.start)) beginning[node.obstacle].add(before ? before->gap : node.start, node.contact);
    if (node.contact && !(before && before->contact)) of_newcomers[node.obstacle].add(node);
  }
  for (std::size_t k = 0; k < after.size(); ++k) {
    if (!after[k].has_direction() || of_newcomers[k].size <= most * after[k].size) continue;
    if (block::dot<B>(before[k].force.data(), after[k].force.data()) < 0 && before[k].has_direction())
      return "friction turned round";
    if (!followed && before[k].size == 0 && !beginning[k].stays()) return "contact moved on from where it was";
  }
  return nullptr;
}

namespace {

/// The mean motions of bodies that have no vertex in common.
template <int D>
class MeanMotions {
 public:
  MeanMotions(const Nodes<D>& nodes, Plane plane, const std::vector<double>& by)
      : nodes_(nodes), body_(nodes.size(), -1), of_(1) {
    const std::vector<Index> part = connected_parts(nodes.mesh());
    of_.resize(static_cast<std::size_t>(*std::ranges::max_element(part)) + 1);
    std::vector<double> vertices(of_.size());
    for (Index v = 0; v < nodes.mesh().vertices(); ++v) {
      const Index p = nodes.of_vertex(v);
      body_[p] = part[v];
      ++vertices[part[v]];
      for (int i = 0; i < D; ++i) of_[part[v]][i] += by[Offset{p} * D + i];
    }
    for (std::size_t k = 0; k < of_.size(); ++k) {
      for (double& component : of_[k]) component /= vertices[k];
      of_[k] = symmetric_motion<D>(nodes.mesh(), plane, of_[k]);
    }
  }
  const Point<D>& at(Index node) const { return of_[body_[nodes_.ends(node)[0]]]; }

 private:
  const Nodes<D>& nodes_;
  std::vector<Index> body_;  // per node; only those at vertices have one
  std::vector<Point<D>> of_;
};

/// How bodies came to one obstacle.
template <int D>
struct Approach {
  Point<D> way{}, normal{};       // weighted by what presses
  double pressed = 0, limit = 0;  // sums of what presses, and of what friction may do
  double apart = infinity;        // when the step began
  bool touched = false;           // then

  /// Which part of the way they were apart, where that matters to friction: not where they hardly move along the
  /// surface, nor so much that all slips in any case.
  double in_flight() const {
    constexpr double flat = 0.1, steep = 4;  // of the way that friction may hold back
    const double size = length<D>(normal);
    if (touched || !(apart > 0) || !(limit > 0) || !(size > 0)) return 0;
    const double down = -dot(way, normal) / (size * pressed);
    const double along = std::sqrt(std::max(dot(way, way) / (pressed * pressed) - down * down, 0.0));
    const double held = limit / pressed * down;
    return down > 0 && along > flat * held && along < steep * held ? std::min(apart / down, 1.0) : 0;
  }
};

}  // namespace

template <int D>
const char* doubt_of_approach(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& last,
                              const ContactState<D>& now, const std::vector<ContactNode<D>>& masters,
                              const std::vector<double>& by, double part) {
  constexpr double noticeable = 0.2;  // more than a coarse mesh leaves between round bodies drawn in contact
  const MeanMotions<D> motions(nodes, model.plane, by);
  std::vector<Approach<D>> of(now.obstacles.size());
  for (const ContactNode<D>& node : last.nodes) of[node.obstacle].touched |= node.contact;
  const auto add_way = [&](const ContactNode<D>& node, double weight) {
    for (int i = 0; i < D; ++i) of[node.obstacle].way[i] += weight * motions.at(node.vertex)[i];
  };
  for (const ContactNode<D>& node : now.nodes) {
    Approach<D>& to = of[node.obstacle];
    const ContactNode<D>* before = same(last, node);
    to.apart = std::min(to.apart, before ? before->gap : node.start);
    const double presses = node.contact ? std::max(node.pressure, 0.0) * node.area : 0;
    if (!(presses > 0)) continue;
    to.pressed += presses;
    to.limit += node.law.coefficient * presses;
    for (int i = 0; i < D; ++i) to.normal[i] += presses * node.direction[i];
    add_way(node, presses);
  }
  std::vector<double> on_masters(of.size());
  for (const ContactNode<D>& node : masters) on_masters[node.obstacle] += std::max(node.pressure, 0.0) * node.area;
  for (const ContactNode<D>& node : masters)
    if (const double all = on_masters[node.obstacle]; all > 0)
      add_way(node, -std::max(node.pressure, 0.0) * node.area / all * of[node.obstacle].pressed);
  for (const Approach<D>& to : of)
    if (to.in_flight() * part > noticeable) return "bodies came along the surface before they touched";
  return nullptr;
}

template const char* doubt_of_friction(const ContactState<1>&, const ContactState<1>&, bool);
template const char* doubt_of_friction(const ContactState<2>&, const ContactState<2>&, bool);
template const char* doubt_of_friction(const ContactState<3>&, const ContactState<3>&, bool);
template const char* doubt_of_approach(const Nodes<2>&, const Model<2>&, const ContactState<2>&, const ContactState<2>&,
                                       const std::vector<ContactNode<2>>&, const std::vector<double>&, double);
template const char* doubt_of_approach(const Nodes<3>&, const Model<3>&, const ContactState<3>&, const ContactState<3>&,
                                       const std::vector<ContactNode<3>>&, const std::vector<double>&, double);

}  // namespace signorini
