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

template <int B>
bool touches(const ContactState<B>& contact, const ContactNode<B>& node) {
  auto other = std::ranges::lower_bound(contact.nodes, node.vertex, {}, &ContactNode<B>::vertex);
  for (; other != contact.nodes.end() && other->vertex == node.vertex; ++other)
    if (other->contact && other->obstacle == node.obstacle) return true;
  return false;
}

}  // namespace

template <int B>
bool turned_at_newcomers(const ContactState<B>& last, const ContactState<B>& now) {
  std::vector<Drag<B>> before(now.obstacles.size()), after(now.obstacles.size()), of_newcomers(now.obstacles.size());
  for (const ContactNode<B>& node : last.nodes) before[node.obstacle].add(node);
  for (const ContactNode<B>& node : now.nodes) {
    after[node.obstacle].add(node);
    if (node.contact && !touches(last, node)) of_newcomers[node.obstacle].add(node);
  }
  for (std::size_t k = 0; k < after.size(); ++k)
    if (before[k].has_direction() && after[k].has_direction() && of_newcomers[k].size > most * after[k].size &&
        block::dot<B>(before[k].force.data(), after[k].force.data()) < 0)
      return true;
  return false;
}

template bool turned_at_newcomers(const ContactState<1>&, const ContactState<1>&);
template bool turned_at_newcomers(const ContactState<2>&, const ContactState<2>&);
template bool turned_at_newcomers(const ContactState<3>&, const ContactState<3>&);

}  // namespace signorini
