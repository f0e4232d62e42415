#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/fem/elements/element.hpp"
#include "core/fem/recovery/coincidence_set.hpp"
#include "core/fem/recovery/contact_surface.hpp"

namespace signorini {

/// Elements or faces of the obstacle around the held nodes.
template <int D>
class HeldSurroundings {
 public:
  HeldSurroundings(const Nodes<D>& nodes, Index obstacle, const std::vector<ContactNode<1>>& contact,
                   const std::vector<HeldBound<1>>& held)
      : state_(static_cast<std::size_t>(nodes.size()), off), density_(state_.size()) {
    for (const ContactNode<1>& node : contact)
      if (node.obstacle == obstacle && node.contact)
        state_[node.vertex] = presses, density_[node.vertex] = node.pressure * node.direction[0];
    for (const HeldBound<1>& h : held)
      if (h.bound.obstacle == obstacle) state_[h.bound.vertex] = holds, at_[h.bound.vertex] = {};
  }

  template <class Corners>
  void add(const Corners& corners, double size) {
    const auto held = std::ranges::count_if(corners, [&](Index p) { return state_[p] == holds; });
    if (held == 0) return;
    if (held == std::ssize(corners)) {
      between_.push_back({{corners.begin(), corners.end()}, size});
      return;
    }
    const bool in = std::ranges::all_of(corners, [&](Index p) { return state_[p] != off; });
    for (const Index p : corners) {
      if (state_[p] != holds) continue;
      Around& around = at_[p];
      around.add(in, size);
      for (const Index q : corners)
        if (in && state_[q] == presses) around.densities.push_back(density_[q]);
    }
  }

  /// What lies between held nodes alone is as what is beside it, if that agrees.
  void finish() {
    std::vector<std::pair<Index, Around>> more;
    for (const auto& [corners, size] : between_) {
      Around beside;
      for (const Index q : corners) beside.add(at_[q]);
      const bool in = beside.in > 0 && beside.in == beside.all;
      for (const Index p : corners)
        more.emplace_back(p, in ? Around{size, size, beside.densities} : Around{0, size, {}});
    }
    for (const auto& [p, around] : more) at_[p].add(around);
  }

  /// How much of a node's area lies in the set, and the density there; none where that is nothing.
  std::pair<double, double> at(Index p) {
    Around& around = at_[p];
    return around.densities.empty() ? std::pair(0.0, 0.0) : std::pair(around.in / around.all, median(around.densities));
  }

 private:
  struct Around {
    double in = 0, all = 0;
    std::vector<double> densities = {};
    void add(bool is_in, double size) { all += size, in += is_in ? size : 0; }
    void add(const Around& other) {
      in += other.in, all += other.all;
      densities.insert(densities.end(), other.densities.begin(), other.densities.end());
    }
  };
  struct Between {
    std::vector<Index> corners;
    double size;
  };

  enum State : char { off, presses, holds };
  std::vector<char> state_;      // per node
  std::vector<double> density_;  // per node, with the sign of the force
  std::map<Index, Around> at_;
  std::vector<Between> between_;
};

/// Where values are prescribed that a scalar obstacle touches: of such nodes those whose surroundings rest on it belong
/// to the contact. The reaction there is the boundary's and the obstacle's together; the obstacle's is as dense as
/// beside the node, over so much of the node's area as lies in elements, or faces of the obstacle, all of whose nodes
/// touch it.
/// @param contact the other nodes, with areas and pressures
/// @param held nodes that touch, by ascending vertex
template <int D>
std::vector<ContactNode<1>> held_in_set(const Nodes<D>& nodes, const ContactSurface<D, 1>& surface, Index obstacle,
                                        const std::vector<ContactNode<1>>& contact,
                                        const std::vector<HeldBound<1>>& held) {
  std::vector<ContactNode<1>> out;
  if (std::ranges::none_of(held, [&](const auto& h) { return h.bound.obstacle == obstacle; })) return out;
  HeldSurroundings<D> around(nodes, obstacle, contact, held);
  const Mesh<D>& mesh = nodes.mesh();
  if (surface.in_body())
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      around.add(nodes.of_simplex(e), signed_volume<D>(points_of(mesh, mesh.elements[e])));
  else
    for (const Index face : surface.all_faces()) around.add(nodes.of_face(face), face_measure(nodes, face));
  around.finish();
  for (const HeldBound<1>& h : held) {
    if (h.bound.obstacle != obstacle) continue;
    const auto [part, density] = around.at(h.bound.vertex);
    if (density == 0) continue;
    ContactNode<1> node{};
    node.vertex = h.bound.vertex;
    node.obstacle = obstacle;
    node.contact = true;
    node.direction = {density > 0 ? 1.0 : -1.0};
    node.area = surface.area(node);
    node.recovered = node.pressure = part * std::abs(density);
    node.force[0] = part * density * node.area;
    out.push_back(node);
  }
  return out;
}

}  // namespace signorini
