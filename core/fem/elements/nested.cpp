#include "core/fem/elements/nested.hpp"

#include <algorithm>

namespace signorini {

template <int D>
Prolongation prolongation(const Refinement& refinement, const Nodes<D>& coarse, const Nodes<D>& fine) {
  Prolongation out;
  out.coarse = coarse.size();
  out.midpoints = refinement.uniform;
  const auto size = static_cast<std::size_t>(fine.size());
  out.row.reserve(size + 1);
  out.column.reserve(2 * size);
  out.weight.reserve(2 * size);
  for (Index p = 0; p < fine.size(); ++p) {
    const auto [a, b] = coarse.of(refinement.parents[fine.vertex(p)]);
    out.column.push_back(std::min(a, b));
    out.weight.push_back(a == b ? 1.0 : 0.5);
    if (a != b) {
      out.column.push_back(std::max(a, b));
      out.weight.push_back(0.5);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template <int D>
std::vector<Prolongation> prolongations(const MeshHierarchy<D>& hierarchy, const std::vector<Nodes<D>>& nodes) {
  std::vector<Prolongation> out;
  for (std::size_t k = 0; k < hierarchy.refinements.size(); ++k)
    out.push_back(prolongation(hierarchy.refinements[k], nodes[k], nodes[k + 1]));
  return out;
}

template Prolongation prolongation(const Refinement&, const Nodes<2>&, const Nodes<2>&);
template Prolongation prolongation(const Refinement&, const Nodes<3>&, const Nodes<3>&);
template std::vector<Prolongation> prolongations(const MeshHierarchy<2>&, const std::vector<Nodes<2>>&);
template std::vector<Prolongation> prolongations(const MeshHierarchy<3>&, const std::vector<Nodes<3>>&);

}  // namespace signorini
