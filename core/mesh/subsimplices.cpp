#include "core/mesh/subsimplices.hpp"

#include "core/mesh/simplex.hpp"

namespace signorini {

template <int D>
Numbering number_faces(Index vertices, const std::vector<std::array<Index, D + 1>>& elements) {
  return number_subsimplices<D>(vertices, static_cast<Offset>(elements.size()) * (D + 1), [&](Offset i) {
    return sorted(outward_face<D>(elements[i / (D + 1)], static_cast<int>(i % (D + 1))));
  });
}

template <int D>
Numbering number_edges(Index vertices, const std::vector<std::array<Index, D + 1>>& elements) {
  constexpr auto edges = simplex_edges<D>();
  constexpr auto per_element = static_cast<Offset>(edges.size());
  return number_subsimplices<2>(vertices, static_cast<Offset>(elements.size()) * per_element, [&](Offset i) {
    const auto& element = elements[i / per_element];
    const auto [a, b] = edges[i % per_element];
    return sorted(std::array<Index, 2>{element[a], element[b]});
  });
}

template Numbering number_faces<2>(Index, const std::vector<std::array<Index, 3>>&);
template Numbering number_faces<3>(Index, const std::vector<std::array<Index, 4>>&);
template Numbering number_edges<2>(Index, const std::vector<std::array<Index, 3>>&);
template Numbering number_edges<3>(Index, const std::vector<std::array<Index, 4>>&);

}  // namespace signorini
