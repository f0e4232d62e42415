#include "core/fem/recovery/coincidence_set.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace signorini {
namespace {

/// What presses on the nodes at the edge of the set, as it is farther inside.
template <int D>
class EdgeOfSet {
 public:
  EdgeOfSet(const Nodes<D>& nodes, Index obstacle, const std::vector<ContactNode<1>>& contact)
      : nodes_(nodes), contact_(contact), place_(static_cast<std::size_t>(nodes.size())) {
    for (const ContactNode<1>& node : contact)
      if (node.obstacle == obstacle && node.contact) place_[node.vertex] = inside;
    find_edge();
    find_pressures(obstacle);
    // Nodes whose neighbours are all at the edge take it from these.
    constexpr int rings = 2;
    for (int ring = 0; ring < rings; ++ring) find_densities();
  }

  /// How much of a node's area lies in the set.
  double part(const ContactNode<1>& node) const {
    if (!at_edge(node.vertex)) return 1;
    const double density = density_.at(node.vertex);
    return density > 0 ? std::min(node.pressure / density, 1.0) : 1;
  }

 private:
  enum Place : char { outside, inside, edge };

  bool in_contact(Index p) const { return place_[p] != outside; }
  bool at_edge(Index p) const { return place_[p] == edge; }

  /// Of nodes that share a simplex one is in contact and one is not. Most simplices have corners of one kind only.
  void find_edge() {
    const std::size_t simplices = nodes_.mesh().elements.size();
    for (std::size_t e = 0; e < simplices; ++e) {
      const auto corners = nodes_.of_simplex(e);
      int count = 0;
      for (const Index p : corners) count += in_contact(p);
      if (count == 0 || count == D + 1) continue;
      for (const Index p : corners)
        if (in_contact(p)) place_[p] = edge;
    }
    for (std::size_t e = 0; e < simplices; ++e) {
      bool there = false;
      for (const Index p : nodes_.of_simplex(e)) there |= at_edge(p);
      if (there) around_.push_back(e);
    }
  }

  /// At the nodes of the simplices around the edge, which are all that is asked about.
  void find_pressures(Index obstacle) {
    for (const std::size_t e : around_)
      for (const Index p : nodes_.of_simplex(e))
        if (in_contact(p)) density_.emplace(p, unknown);
    for (const ContactNode<1>& node : contact_)
      if (place_[node.vertex] == inside && node.contact && node.obstacle == obstacle)
        if (const auto found = density_.find(node.vertex); found != density_.end()) found->second = node.pressure;
  }

  void find_densities() {
    std::map<Index, std::vector<double>> beside;
    for (const std::size_t e : around_) {
      const auto corners = nodes_.of_simplex(e);
      for (const Index p : corners) {
        if (!at_edge(p) || density_.at(p) != unknown) continue;
        for (const Index q : corners)
          if (const double there = density(q); there != unknown) beside[p].push_back(there);
      }
    }
    for (auto& [p, values] : beside) density_[p] = median(values);
  }

  double density(Index p) const { return in_contact(p) ? density_.at(p) : unknown; }

  static constexpr double unknown = -1;
  const Nodes<D>& nodes_;
  const std::vector<ContactNode<1>>& contact_;
  std::vector<Place> place_;                   // of each node
  std::vector<std::size_t> around_;            // simplices with nodes at the edge
  std::unordered_map<Index, double> density_;  // of what presses at nodes of these
};

}  // namespace

template <int D>
double coincidence_set(const Nodes<D>& nodes, Index obstacle, const std::vector<ContactNode<1>>& contact) {
  const EdgeOfSet<D> edge(nodes, obstacle, contact);
  double sum = 0;
  for (const ContactNode<1>& node : contact)
    if (node.obstacle == obstacle && node.contact) sum += edge.part(node) * node.area;
  return sum;
}

template double coincidence_set(const Nodes<2>&, Index, const std::vector<ContactNode<1>>&);
template double coincidence_set(const Nodes<3>&, Index, const std::vector<ContactNode<1>>&);

}  // namespace signorini
