#include "core/fem/recovery/forces.hpp"

#include "core/sdk/block.hpp"

namespace signorini {
namespace {

/// Calls use(node, row) for the contact nodes at vertices with prescribed components.
template <int B, class Use>
void each_at_fixes(const std::vector<FixedDirections<B>>& fixes, const ContactState<B>& contact, const Use& use) {
  std::size_t row = 0;
  for (const ContactNode<B>& node : contact.nodes) {
    while (row < fixes.size() && fixes[row].vertex < node.vertex) ++row;
    if (row < fixes.size() && fixes[row].vertex == node.vertex) use(node, fixes[row]);
  }
}

/// Adds `force` to the reaction of the fix that prescribes direction k; what the axis prescribes has none.
template <int B>
void add(const FixedDirections<B>& fixed, int k, double force, Forces<B>& to) {
  if (fixed.fix[k] < 0) return;
  typename Forces<B>::AtNode at_node{fixed.vertex, fixed.fix[k], {}};
  for (int i = 0; i < B; ++i) {
    at_node.force[i] = force * fixed.direction[k][i];
    to.reactions[fixed.fix[k]][i] += at_node.force[i];
  }
  if (B > 1) to.at_fixes.push_back(at_node);
}

}  // namespace

template <int B>
Forces<B> forces(const Model<B>& model, const Discretization<B>& discretization, const ContactState<B>& contact,
                 const std::vector<double>& x) {
  Forces<B> out;
  out.applied = discretization.applied;
  for (const ContactSummary<B>& obstacle : contact.obstacles) out.contact.push_back(obstacle.force);
  out.reactions.assign(model.fixes.size(), {});
  const std::vector<FixedDirections<B>>& fixes = discretization.fixes;
  for (std::size_t row = 0; row < fixes.size(); ++row)
    for (int k = 0; k < fixes[row].count; ++k) {
      double along[B];
      std::copy_n(fixes[row].direction[k], B, along);
      if (const double* N = discretization.problem.frames.dual_at(fixes[row].vertex))
        block::transposed_product<B>(N, fixes[row].direction[k], along);
      add(fixes[row], k, discretization.prescribed.force(static_cast<Index>(row), along, x), out);
    }
  each_at_fixes(fixes, contact, [&](const ContactNode<B>& node, const FixedDirections<B>& fixed) {
    for (int k = 0; k < fixed.count; ++k) add(fixed, k, -block::dot<B>(node.force.data(), fixed.direction[k]), out);
  });
  return out;
}

template Forces<1> forces(const Model<1>&, const Discretization<1>&, const ContactState<1>&,
                          const std::vector<double>&);
template Forces<2> forces(const Model<2>&, const Discretization<2>&, const ContactState<2>&,
                          const std::vector<double>&);
template Forces<3> forces(const Model<3>&, const Discretization<3>&, const ContactState<3>&,
                          const std::vector<double>&);

}  // namespace signorini
