#include "core/mesh/connected.hpp"

#include <algorithm>
#include <numeric>

namespace signorini {
namespace {

/// The vertex that stands for the part of v; halves the way there (Tarjan and van Leeuwen, J. ACM 31, 1984).
Index root(std::vector<Index>& parent, Index v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

template <int D>
std::vector<Index> connected_parts(const Mesh<D>& mesh) {
  std::vector<Index> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& element : mesh.elements)
    for (const Index v : element) {
      const auto [first, last] = std::minmax({root(parent, element[0]), root(parent, v)});
      parent[last] = first;
    }
  // A root is the first vertex of its part.
  std::vector<Index> out(parent.size());
  Index parts = 0;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    const Index first = root(parent, v);
    out[v] = first == v ? parts++ : out[first];
  }
  return out;
}

template std::vector<Index> connected_parts(const Mesh<2>&);
template std::vector<Index> connected_parts(const Mesh<3>&);

}  // namespace signorini
