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
                                         const DiscreteProblem<B>& problem, const ContactState<B>& contact,
                                         const std::vector<TieForce<B>>& ties) {
  std::vector<NodalForce<B>> out;
  if (!problem.jumps) return out;
  const std::vector<std::vector<Index>> of_slave = slave_nodes(nodes, model);
  const BlockRows<B>& rows = problem.jumps->inverse;
  const auto add = [&](const NodalForce<B>& on_slave) {
    const auto found = std::ranges::lower_bound(problem.jumps->vector, on_slave.node);
    if (found == problem.jumps->vector.end() || *found != on_slave.node) return;
    const auto s = found - problem.jumps->vector.begin();
    for (Offset k = rows.row[s]; k < rows.row[s + 1]; ++k) {
      const Index q = rows.column[k];
      if (q == on_slave.node) continue;
      NodalForce<B>& back = out.emplace_back(on_slave);
      back.node = q;
      back.on_slave = std::ranges::binary_search(of_slave[on_slave.obstacle], q);
      block::transposed_product<B>(rows.at(k), on_slave.force.data(), back.force.data());
      block::transposed_product<B>(rows.at(k), on_slave.tangential.data(), back.tangential.data());
    }
  };
  for (const ContactNode<B>& node : contact.nodes)
    add({node.vertex, node.obstacle, node.force, node.tangential, true, node.friction, node.sticks});
  for (const TieForce<B>& tie : ties) add(tie);
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
                                                    const ContactState<B>&, const std::vector<TieForce<B>>&);
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
