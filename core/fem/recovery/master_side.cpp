#include "core/fem/recovery/master_side.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/fem/elements/element.hpp"
#include "core/fem/pairs/added_gap.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/pairs/slave_choice.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "core/fem/recovery/pressure_recovery.hpp"

namespace signorini {
namespace {

/// The master of one obstacle.
template <int D>
class Master {
 public:
  /// @param model with that obstacle's sides exchanged
  Master(const Nodes<D>& nodes, const Model<D>& model, Index obstacle)
      : nodes_(nodes), model_(model), obstacle_(obstacle), surface_(nodes, model, obstacle) {}

  /// Adds its nodes.
  void find(const std::vector<NodalForce<D>>& forces, const std::vector<double>& u, MasterSide<D>& to) {
    add_nodes(u);
    add_forces(forces);
    double largest = 0;
    for (ContactNode<D>& node : out_) largest = std::max(largest, press(node));
    const double least = positive_force * largest;
    for (ContactNode<D>& node : out_) {
      node.contact = node.pressure * node.area > least;
      if (!node.contact) node.recovered = node.pressure = 0;
    }
    std::vector<std::array<double, D>> traction;
    for (const ContactNode<D>& node : out_) traction.push_back(node.traction);
    to.pressures[obstacle_] = recover_pressure(nodes_, surface_, obstacle_, least, out_);
    // Of the recovered pressure the part that friction is of the nodal one: so it stays within Coulomb's law.
    for (std::size_t k = 0; k < out_.size(); ++k) {
      out_[k].traction = traction[k];
      const double part = out_[k].pressure > 0 ? std::min(out_[k].recovered / out_[k].pressure, 1.0) : 0;
      for (double& t : out_[k].traction) t *= part;
    }
    to.nodes.insert(to.nodes.end(), out_.begin(), out_.end());
    to.seen[obstacle_] = std::move(seen_);
  }

 private:
  /// Those that the other body is in front of, with their distances to it.
  void add_nodes(const std::vector<double>& u) {
    const ObstacleTerm<D>& term = model_.obstacles[obstacle_];
    const PairedFaces faces = paired_faces(nodes_.mesh(), term, model_.t);
    const MortarCoupling<D> found = couple_sides(nodes_, model_, term, faces.slave, faces.master);
    std::vector<Index> order(found.node.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, {}, [&](Index k) { return nodes_.of_vertex(found.node[k]); });
    for (const Index k : order) {
      ContactNode<D> node{};
      node.vertex = nodes_.of_vertex(found.node[k]);
      seen_.node.push_back(node.vertex);
      node.obstacle = obstacle_;
      std::array<double, D> jump;
      std::copy_n(u.data() + Offset{node.vertex} * D, D, jump.begin());
      for (Offset j = found.row[k]; j < found.row[k + 1]; ++j) {
        const Index q = nodes_.of_vertex(found.column[j]);
        for (int i = 0; i < D; ++i) jump[i] -= found.value[j] * u[static_cast<std::size_t>(Offset{q} * D + i)];
        seen_.column.push_back(q), seen_.weight.push_back(found.value[j]);
      }
      seen_.row.push_back(static_cast<Offset>(seen_.column.size()));
      const double before = std::clamp(found.gap[k] / found.part(k), found.nearest[k], found.farthest[k]);
      node.gap = before - dot(found.normal[k], jump) / found.part(k) +
                 added_gap<D>(term, nodes_.at(node.vertex), found.normal[k]);
      for (int i = 0; i < D; ++i) node.direction[i] = -found.normal[k][i];
      node.covered = found.covered[k];
      out_.push_back(node);
    }
  }

  /// A node sticks where most of the force comes from the slave's nodes that do.
  void add_forces(const std::vector<NodalForce<D>>& forces) {
    std::vector<double> sticking(out_.size());
    for (const NodalForce<D>& force : forces) {
      if (force.obstacle != obstacle_ || force.on_slave) continue;
      ContactNode<D>* node = at(force.node);
      if (!node) continue;
      for (int i = 0; i < D; ++i) node->force[i] += force.force[i];
      node->friction |= force.friction;
      const double size = std::sqrt(dot(force.force, force.force));
      if (force.friction) sticking[static_cast<std::size_t>(node - out_.data())] += force.sticks ? size : -size;
    }
    for (std::size_t k = 0; k < out_.size(); ++k) out_[k].sticks = out_[k].friction && sticking[k] > 0;
  }

  ContactNode<D>* at(Index node) {
    const auto found = std::ranges::lower_bound(out_, node, {}, &ContactNode<D>::vertex);
    return found != out_.end() && found->vertex == node ? &*found : nullptr;
  }

  /// Splits a force into what presses and what shears. @return the former
  double press(ContactNode<D>& node) const {
    node.area = std::max(node.covered, node.least_covered) * surface_.area(node);
    const double force = std::max(dot(node.force, node.direction), 0.0);
    for (int i = 0; i < D; ++i) node.tangential[i] = node.force[i] - force * node.direction[i];
    if (!(node.area > 0)) return force;
    node.recovered = node.pressure = force / node.area;
    for (int i = 0; i < D; ++i) node.traction[i] = node.tangential[i] / node.area;
    return force;
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const Index obstacle_;
  const ContactSurface<D, D> surface_;
  std::vector<ContactNode<D>> out_;
  MasterMeans seen_;
};

}  // namespace

template <int D, int B>
MasterSide<B> master_side(const Nodes<D>& nodes, const Model<B>& model, const std::vector<NodalForce<B>>& counterforces,
                          const std::vector<double>& u) {
  MasterSide<B> out;
  out.pressures.resize(model.obstacles.size()), out.seen.resize(model.obstacles.size());
  if constexpr (D == B) {
    if (!is_paired(model)) return out;
    Model<B> exchanged = model;
    std::vector<SlaveChoice> choices;
    for (const ObstacleTerm<B>& term : model.obstacles) choices.push_back({term.other.has_value(), ""});
    exchange_sides(choices, exchanged);
    for (Index k = 0; k < std::ssize(model.obstacles); ++k) {
      if (!model.obstacles[k].other || model.obstacles[k].tied) continue;
      Master<D>(nodes, exchanged, k).find(counterforces, u, out);
    }
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                       \
  template MasterSide<B> master_side(const Nodes<D>&, const Model<B>&, const std::vector<NodalForce<B>>&, \
                                     const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
