#include "driver/levels/turned_friction.hpp"

#include <algorithm>
#include <cmath>

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

/// What touches first of an obstacle: nodes as near as the nearest one is before a step, but for rounding.
class Beginning {
 public:
  explicit Beginning(double rounding) : rounding_(rounding) {}
  /// @param gap of a node then
  void add(double gap, bool touches) {
    if (gap < least_ - rounding_) stays_ = false;
    if (gap <= least_ + rounding_) stays_ = stays_ || touches;
    least_ = std::min(least_, gap);
  }
  /// Whether one of them touches after the step.
  bool stays() const { return stays_; }

 private:
  double rounding_, least_ = infinity;
  bool stays_ = false;
};

}  // namespace

template <int B>
const ContactNode<B>* same_node(const ContactState<B>& contact, const ContactNode<B>& node) {
  auto other = std::ranges::lower_bound(contact.nodes, node.vertex, {}, &ContactNode<B>::vertex);
  for (; other != contact.nodes.end() && other->vertex == node.vertex; ++other)
    if (other->obstacle == node.obstacle) return &*other;
  return nullptr;
}

template <int B>
const char* doubt_of_friction(const ContactState<B>& last, const ContactState<B>& now, bool followed, double rounding) {
  std::vector<Beginning> beginning(now.obstacles.size(), Beginning(rounding));
  std::vector<Drag<B>> before(now.obstacles.size()), after(now.obstacles.size()), of_newcomers(now.obstacles.size());
  for (const ContactNode<B>& node : last.nodes) before[node.obstacle].add(node);
  for (const ContactNode<B>& node : now.nodes) {
    after[node.obstacle].add(node);
    const ContactNode<B>* before = same_node(last, node);
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

template const ContactNode<1>* same_node(const ContactState<1>&, const ContactNode<1>&);
template const ContactNode<2>* same_node(const ContactState<2>&, const ContactNode<2>&);
template const ContactNode<3>* same_node(const ContactState<3>&, const ContactNode<3>&);
template const char* doubt_of_friction(const ContactState<1>&, const ContactState<1>&, bool, double);
template const char* doubt_of_friction(const ContactState<2>&, const ContactState<2>&, bool, double);
template const char* doubt_of_friction(const ContactState<3>&, const ContactState<3>&, bool, double);

}  // namespace signorini
