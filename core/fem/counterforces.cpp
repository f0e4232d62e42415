#include "core/fem/counterforces.hpp"

#include <algorithm>

#include "core/sdk/block.hpp"

namespace signorini {

template <int B>
std::vector<NodalForce<B>> counterforces(const DiscreteProblem<B>& problem, const ContactState<B>& contact) {
  std::vector<NodalForce<B>> out;
  if (!problem.jumps) return out;
  const Jumps<B>& jumps = *problem.jumps;
  for (const ContactNode<B>& node : contact.nodes) {
    const auto found = std::ranges::lower_bound(jumps.vector, node.vertex);
    if (found == jumps.vector.end() || *found != node.vertex) continue;
    const auto s = found - jumps.vector.begin();
    double back[B];
    block::product<B>(jumps.project.data() + s * B * B, node.force.data(), back);
    for (Offset k = jumps.row[s]; k < jumps.row[s + 1]; ++k) {
      NodalForce<B>& force = out.emplace_back(NodalForce<B>{jumps.column[k], node.obstacle, {}});
      for (int i = 0; i < B; ++i) force.force[i] = -jumps.weight[k] * back[i];
    }
  }
  return out;
}

template <int B>
std::vector<std::array<double, B>> totals(const std::vector<NodalForce<B>>& forces, std::size_t obstacles) {
  std::vector<std::array<double, B>> out(obstacles);
  for (const NodalForce<B>& force : forces)
    for (int i = 0; i < B; ++i) out[force.obstacle][i] += force.force[i];
  return out;
}

#define SIGNORINI_INSTANTIATE(B)                                                                        \
  template std::vector<NodalForce<B>> counterforces(const DiscreteProblem<B>&, const ContactState<B>&); \
  template std::vector<std::array<double, B>> totals<B>(const std::vector<NodalForce<B>>&, std::size_t);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
