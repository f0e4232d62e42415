#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini {

/// Whether each node is one of a part of the body; all are where it has none.
template <int D>
std::vector<char> nodes_of_part(const Scene& scene, const Scene::Body& body, std::size_t part, const Nodes<D>& nodes) {
  std::vector<char> inside(static_cast<std::size_t>(nodes.size()), body.parts.empty());
  if (body.parts.empty()) return inside;
  const auto [first, count] = regions_of_part(scene, body, part);
  with_order(nodes, [&, first = first, count = count](auto order) {
    const auto& elements = nodes.template elements<order>();
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (nodes.region(e) >= first && nodes.region(e) < first + count)
        for (const Index p : nodes.of(elements[e])) inside[p] = true;
  });
  return inside;
}

}  // namespace signorini
