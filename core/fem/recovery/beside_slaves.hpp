#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/sorted_range.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/recovery/counterforces.hpp"
#include "core/fem/recovery/meeting_faces.hpp"

namespace signorini {

/// Pressures of obstacles at nodes beside which another body, as a slave, touches the same body: there the obstacle has
/// the force on what both are in front of. (The slave's own node gives way: what the obstacle holds does not press it.)
/// The pressure is all that presses there over all of that area. Forces stay what they are, those in equilibrium.
template <int D>
class BesideSlaves {
 public:
  /// Keeps references.
  /// @param contact by ascending vertex, with forces as pressures
  BesideSlaves(const Nodes<D>& nodes, const Model<D>& model, const Discretization<D>& discretization,
               std::vector<ContactNode<D>>& contact)
      : nodes_(nodes), model_(model), discretization_(discretization), contact_(contact) {}

  void spread() {
    if (std::ranges::none_of(contact_, [this](const auto& node) { return presses(node); })) return;
    ContactState<D> state;
    state.nodes = contact_;
    std::vector<NodalForce<D>> forces = counterforces(nodes_, model_, discretization_.problem, state);
    std::erase_if(forces, [](const auto& force) { return force.on_slave || dot(force.force, force.force) == 0; });
    std::ranges::stable_sort(forces, {}, &NodalForce<D>::node);
    for (Index pair = 0; pair < std::ssize(model_.obstacles); ++pair)
      if (std::ranges::find(forces, pair, &NodalForce<D>::obstacle) != forces.end()) spread(pair, forces);
  }

 private:
  bool presses(const ContactNode<D>& node) const {
    return node.contact && !node.held && !model_.obstacles[node.obstacle].other;
  }

  bool rests_on_obstacle(Index vertex) const {
    return std::ranges::any_of(at(vertex), [this](const auto& node) { return presses(node); });
  }

  auto at(Index vertex) const { return part_with(contact_, vertex, &ContactNode<D>::vertex); }

  /// @param forces by ascending node
  void spread(Index pair, const std::vector<NodalForce<D>>& forces) {
    Model<D> exchanged = model_;
    ObstacleTerm<D>& term = exchanged.obstacles[pair];
    std::swap(term.on, term.other);
    const PairedFaces faces = paired_faces(nodes_.mesh(), term, model_.t);
    const MortarCoupling<D> slave = couple_sides(nodes_, exchanged, term, faces.slave, faces.master);
    const ContactSurface<D, D> surface(nodes_, exchanged, pair);
    for (Index k = 0; k < slave.nodes(); ++k) {
      ContactNode<D> node{};
      node.vertex = nodes_.of_vertex(slave.node[k]);
      if (!rests_on_obstacle(node.vertex)) continue;
      for (int i = 0; i < D; ++i) node.direction[i] = -slave.normal[k][i];
      if (!touches_beside(pair, forces, surface.faces(node))) continue;
      double force = 0;
      for (const NodalForce<D>& f : part_with(forces, node.vertex, &NodalForce<D>::node))
        if (f.obstacle == pair) force += dot(f.force, node.direction);
      spread(node, force, slave.covered[k], surface);
    }
  }

  /// Whether the slave presses on some node of the master's faces.
  bool touches_beside(Index pair, const std::vector<NodalForce<D>>& forces, const std::vector<Index>& faces) const {
    const auto pressed = [&](Index p) {
      return std::ranges::any_of(part_with(forces, p, &NodalForce<D>::node),
                                 [&](const auto& force) { return force.obstacle == pair; });
    };
    return std::ranges::any_of(faces, [&](Index f) { return std::ranges::any_of(nodes_.of_face(f), pressed); });
  }

  /// @param node of the master, with what presses there
  /// @param force of the slave along that
  /// @param covered part of the master's area that the slave is in front of
  void spread(const ContactNode<D>& node, double force, double covered, const ContactSurface<D, D>& master) {
    const auto same = [&](const ContactNode<D>& other) {
      return presses(other) && push_the_same_way<D>(other.direction, node.direction);
    };
    std::vector<Index> faces;
    double own = 0;
    for (const ContactNode<D>& other : at(node.vertex)) {
      if (!same(other)) continue;
      own += add(faces, surface_of(other.obstacle).faces(other), node.vertex);
      force += other.pressure;
    }
    if (!(own > 0)) return;
    const double of_master = master.area(node);
    const double all = own + add(faces, master.faces(node), node.vertex);
    const double pressure = std::max(force, 0.0) / std::min(all, own + covered * of_master);
    for (ContactNode<D>& other : at(node.vertex))
      if (same(other)) other.pressure = pressure * surface_of(other.obstacle).area(other);
  }

  /// @return the area at a vertex of those that are not among them yet
  double add(std::vector<Index>& faces, const std::vector<Index>& more, Index vertex) const {
    double area = 0;
    for (const Index face : more) {
      if (std::ranges::find(faces, face) != faces.end()) continue;
      faces.push_back(face);
      area += face_share(nodes_, face, vertex, model_.plane);
    }
    return area;
  }

  const ContactSurface<D, D>& surface_of(Index obstacle) {
    surfaces_.resize(model_.obstacles.size());
    if (!surfaces_[obstacle]) surfaces_[obstacle].emplace(nodes_, model_, obstacle);
    return *surfaces_[obstacle];
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const Discretization<D>& discretization_;
  std::vector<ContactNode<D>>& contact_;
  std::vector<std::optional<ContactSurface<D, D>>> surfaces_;
};

}  // namespace signorini
