#include "core/fem/recovery/counterforces.hpp"

#include <algorithm>

#include "core/fem/elements/select.hpp"
#include "core/sdk/block.hpp"

namespace signorini {

namespace {

/// The nodes of the slave of each obstacle between bodies.
template <int D, int B>
std::vector<std::vector<Index>> slave_nodes(const Nodes<D>& nodes, const Model<B>& model) {
  std::vector<std::vector<Index>> out;
  for (const ObstacleTerm<B>& term : model.obstacles) {
    out.emplace_back();
    if (term.other) out.back() = surface(nodes, select_faces(nodes.mesh(), *term.on, model.t)).nodes;
  }
  return out;
}

}  // namespace

template <int D, int B>
std::vector<NodalForce<B>> counterforces(const Nodes<D>& nodes, const Model<B>& model,
                                         const DiscreteProblem<B>& problem, const ContactState<B>& contact) {
  std::vector<NodalForce<B>> out;
  if (!problem.jumps) return out;
  const std::vector<std::vector<Index>> of_slave = slave_nodes(nodes, model);
  const Jumps<B>& jumps = *problem.jumps;
  for (const ContactNode<B>& node : contact.nodes) {
    const auto found = std::ranges::lower_bound(jumps.vector, node.vertex);
    if (found == jumps.vector.end() || *found != node.vertex) continue;
    const auto s = found - jumps.vector.begin();
    double back[B], along[B];
    block::transposed_product<B>(jumps.project.data() + s * B * B, node.force.data(), back);
    block::transposed_product<B>(jumps.project.data() + s * B * B, node.tangential.data(), along);
    for (Offset k = jumps.row[s]; k < jumps.row[s + 1]; ++k) {
      const Index q = jumps.column[k];
      const bool on_slave = std::ranges::binary_search(of_slave[node.obstacle], q);
      NodalForce<B>& force =
          out.emplace_back(NodalForce<B>{q, node.obstacle, {}, {}, on_slave, node.friction, node.sticks});
      for (int i = 0; i < B; ++i) {
        force.force[i] = -jumps.weight[k] * back[i];
        force.tangential[i] = -jumps.weight[k] * along[i];
      }
    }
  }
  return out;
}

template <int B>
std::vector<std::array<double, B>> totals(const std::vector<NodalForce<B>>& forces, std::size_t obstacles,
                                          bool on_slave, PartOfForce<B> part) {
  std::vector<std::array<double, B>> out(obstacles);
  for (const NodalForce<B>& force : forces)
    for (int i = 0; i < B && force.on_slave == on_slave; ++i) out[force.obstacle][i] += (force.*part)[i];
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                              \
  template std::vector<NodalForce<B>> counterforces(const Nodes<D>&, const Model<B>&, const DiscreteProblem<B>&, \
                                                    const ContactState<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE
#define SIGNORINI_INSTANTIATE(B)                                                                              \
  template std::vector<std::array<double, B>> totals<B>(const std::vector<NodalForce<B>>&, std::size_t, bool, \
                                                        PartOfForce<B>);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
