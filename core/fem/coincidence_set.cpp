#include "core/fem/coincidence_set.hpp"

#include <algorithm>
#include <map>

namespace signorini {
namespace {

/// What presses on the nodes at the edge of the set, as it is farther inside.
template <int D>
class EdgeOfSet {
 public:
  EdgeOfSet(const Nodes<D>& nodes, Index obstacle, const std::vector<ContactNode<1>>& contact)
      : nodes_(nodes), contact_(contact), number_(static_cast<std::size_t>(nodes.size()), none) {
    for (std::size_t k = 0; k < contact.size(); ++k)
      if (contact[k].obstacle == obstacle && contact[k].contact) number_[contact[k].vertex] = static_cast<Index>(k);
    find_edge();
    // Nodes whose neighbours are all at the edge take it from these.
    constexpr int rings = 2;
    for (int ring = 0; ring < rings; ++ring) find_densities();
  }

  /// How much of a node's area lies in the set.
  double part(const ContactNode<1>& node) const {
    const auto found = density_.find(node.vertex);
    if (found == density_.end() || !(found->second > 0)) return 1;
    return std::min(node.pressure / found->second, 1.0);
  }

 private:
  bool in_contact(Index p) const { return number_[p] != none; }
  bool at_edge(Index p) const { return density_.contains(p); }

  /// Of nodes that share a simplex one is in contact and one is not.
  void find_edge() {
    const std::size_t simplices = nodes_.mesh().elements.size();
    for (std::size_t e = 0; e < simplices; ++e) {
      const auto corners = nodes_.of_simplex(e);
      const auto inside = std::ranges::count_if(corners, [&](Index p) { return in_contact(p); });
      if (inside == 0 || inside == std::ssize(corners)) continue;
      for (const Index p : corners)
        if (in_contact(p)) density_[p] = unknown;
    }
    if (density_.empty()) return;
    for (std::size_t e = 0; e < simplices; ++e)
      if (std::ranges::any_of(nodes_.of_simplex(e), [&](Index p) { return in_contact(p) && at_edge(p); }))
        around_.push_back(e);
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

  double density(Index p) const {
    if (!in_contact(p)) return unknown;
    const auto found = density_.find(p);
    return found == density_.end() ? contact_[number_[p]].pressure : found->second;
  }

  /// A few much larger ones, as on a ridge of the obstacle, do not change it.
  static double median(std::vector<double>& values) {
    const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  static constexpr Index none = -1;
  static constexpr double unknown = -1;
  const Nodes<D>& nodes_;
  const std::vector<ContactNode<1>>& contact_;
  std::vector<Index> number_;        // in `contact_`, of each node that is in contact
  std::map<Index, double> density_;  // of nodes at the edge
  std::vector<std::size_t> around_;  // simplices with such nodes
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
