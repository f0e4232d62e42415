#include "core/fem/recovery/ties.hpp"

#include <algorithm>

#include "core/base/dot.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/pairs/pretension.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

/// The slave of one tie: areas and normals at its nodes.
template <int D>
struct SlaveSide {
  Surface<D> surface;
  std::vector<double> areas;
  std::vector<Point<D>> normals;

  SlaveSide(const Nodes<D>& nodes, const Selection& on, Plane plane, double t)
      : surface(signorini::surface(nodes, select_faces(nodes.mesh(), on, t))),
        areas(node_areas(nodes, surface, plane)),
        normals(node_normals(nodes, surface)) {}

  std::size_t at(Index node) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(surface.nodes, node) - surface.nodes.begin());
  }
};

/// In a row of prescribed components along a direction in global coordinates.
template <int B>
double force_along(const Discretization<B>& discretization, Index row, const double* direction,
                   const std::vector<double>& x) {
  double along[B];
  std::copy_n(direction, B, along);
  if (const double* N = discretization.problem.frames.dual_at(discretization.prescribed.vertex[row]))
    block::transposed_product<B>(N, direction, along);
  return discretization.prescribed.force(row, along, x);
}

/// Along the directions that the tie prescribes.
template <int B>
std::array<double, B> force_at(const Discretization<B>& discretization, const TiedNode& tie,
                               const std::vector<double>& x) {
  const Index row = discretization.prescribed.at(tie.node);
  const FixedDirections<B>& fixed = discretization.fixes[row];
  std::array<double, B> out{};
  for (int k = 0; k < fixed.count; ++k) {
    if (fixed.fix[k] != by_tie(tie.obstacle)) continue;
    const double size = force_along(discretization, row, fixed.direction[k], x);
    for (int i = 0; i < B; ++i) out[i] += size * fixed.direction[k][i];
  }
  return out;
}

/// What pulls at the carrier of a bolt that is not locked: the force that is given.
template <int D>
void add_pull(const Model<D>& model, const Discretization<D>& discretization, const std::vector<double>& x,
              std::vector<TieForce<D>>& ties) {
  for (const PretensionedTie<D>& cut : discretization.pairs->pretensioned) {
    if (model.obstacles[cut.obstacle].pretension->locked) continue;
    const double size =
        pull(cut, model) + force_along(discretization, discretization.prescribed.at(cut.carrier), cut.normal.data(), x);
    TieForce<D>& at = *std::ranges::lower_bound(ties, cut.carrier, {}, &TieForce<D>::node);
    for (int i = 0; i < D; ++i) at.force[i] += size * cut.normal[i];
  }
}

}  // namespace

template <int D, int B>
std::vector<TieForce<B>> tie_forces(const Nodes<D>& nodes, const Model<B>& model,
                                    const Discretization<B>& discretization, const std::vector<double>& x) {
  std::vector<TieForce<B>> out;
  if constexpr (D == B) {
    if (!discretization.pairs) return out;
    std::vector<std::optional<SlaveSide<D>>> slaves(model.obstacles.size());
    for (const TiedNode& tie : discretization.pairs->ties) {
      auto& slave = slaves[tie.obstacle];
      if (!slave) slave.emplace(nodes, *model.obstacles[tie.obstacle].on, model.plane, model.t);
      const std::size_t at = slave->at(tie.node);
      TieForce<B>& force = out.emplace_back();
      force.node = tie.node;
      force.obstacle = tie.obstacle;
      force.on_slave = true;
      force.force = force.tangential = force_at(discretization, tie, x);
      force.area = tie.bears * slave->areas[at];
      const double normal = dot(force.force, slave->normals[at]);
      for (int i = 0; i < B; ++i) force.tangential[i] -= normal * slave->normals[at][i];
    }
    add_pull<D>(model, discretization, x, out);
  }
  return out;
}

template <int D, int B>
std::vector<BoltState> bolts(const Model<B>& model, const Discretization<B>& discretization,
                             const std::vector<TieForce<B>>& ties, const std::vector<double>& x) {
  std::vector<BoltState> out;
  if constexpr (D == B) {
    if (!discretization.pairs) return out;
    for (const PretensionedTie<B>& cut : discretization.pairs->pretensioned) {
      BoltState& bolt = out.emplace_back();
      bolt.obstacle = cut.obstacle;
      bolt.locked = model.obstacles[cut.obstacle].pretension->locked.has_value();
      bolt.force = dot(std::ranges::lower_bound(ties, cut.carrier, {}, &TieForce<B>::node)->force, cut.normal);
      double at[B];
      std::copy_n(x.data() + Offset{cut.carrier} * B, B, at);
      if (const double* Q = discretization.problem.frames.at(cut.carrier))
        block::product<B>(Q, x.data() + Offset{cut.carrier} * B, at);
      bolt.shortening = block::dot<B>(at, cut.normal.data());
    }
  }
  return out;
}

template <int B>
void sum_up(const std::vector<TieForce<B>>& ties, std::vector<ContactSummary<B>>& obstacles) {
  for (const TieForce<B>& tie : ties) {
    ContactSummary<B>& sum = obstacles[tie.obstacle];
    sum.tied = true;
    ++sum.nodes;
    sum.area += tie.area;
    for (int i = 0; i < B; ++i) {
      sum.force[i] += tie.force[i];
      sum.tangential_force[i] += tie.tangential[i];
    }
  }
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                    \
  template std::vector<TieForce<B>> tie_forces(const Nodes<D>&, const Model<B>&, const Discretization<B>&,             \
                                               const std::vector<double>&);                                            \
  template std::vector<BoltState> bolts<D>(const Model<B>&, const Discretization<B>&, const std::vector<TieForce<B>>&, \
                                           const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE
template void sum_up(const std::vector<TieForce<1>>&, std::vector<ContactSummary<1>>&);
template void sum_up(const std::vector<TieForce<2>>&, std::vector<ContactSummary<2>>&);
template void sum_up(const std::vector<TieForce<3>>&, std::vector<ContactSummary<3>>&);

}  // namespace signorini
