#include "core/mesh/layers.hpp"

#include <algorithm>
#include <cmath>

#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

/// The vertices that share an edge with each vertex, some of them several times.
struct Neighbours {
  std::vector<Offset> row;
  std::vector<Index> column;
};

template <int D>
Neighbours neighbours(const Mesh<D>& mesh) {
  Neighbours out;
  out.row.assign(mesh.points.size() + 2, 0);
  for (const auto& e : mesh.elements)
    for (const Index v : e) out.row[v + 2] += D;
  for (std::size_t v = 2; v < out.row.size(); ++v) out.row[v] += out.row[v - 1];
  out.column.resize(static_cast<std::size_t>(out.row.back()));
  for (const auto& e : mesh.elements)
    for (const auto [a, b] : simplex_edges<D>()) {
      out.column[out.row[e[a] + 1]++] = e[b];
      out.column[out.row[e[b] + 1]++] = e[a];
    }
  return out;
}

/// Breadth first from `start`: sets the layers of all that is connected to it, counted from `first`. Returns the
/// vertices in the order found.
std::vector<Index> flood(const Neighbours& graph, Index start, Index first, std::vector<Index>& layer) {
  std::vector<Index> found{start};
  layer[start] = first;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (Offset k = graph.row[found[i]]; k < graph.row[found[i] + 1]; ++k)
      if (const Index w = graph.column[k]; layer[w] < 0) {
        layer[w] = layer[found[i]] + 1;
        found.push_back(w);
      }
  return found;
}

/// By distance from a vertex at the far end of each connected part (George and Liu, Computer Solution of Large Sparse
/// Positive Definite Systems, 1981, section 4.3).
std::vector<Index> by_distance(const Neighbours& graph, Index vertices) {
  std::vector<Index> layer(static_cast<std::size_t>(vertices), -1);
  Index next = 0;
  for (Index v = 0; v < vertices; ++v) {
    if (layer[v] >= 0) continue;
    Index start = v, depth = -1;
    while (true) {
      const std::vector<Index> found = flood(graph, start, next, layer);
      const Index far = found.back();
      const Index reached = layer[far];
      if (reached <= depth) {
        next = reached + 1;
        break;
      }
      depth = reached;
      start = far;
      for (const Index w : found) layer[w] = -1;
    }
  }
  return layer;
}

/// As many consecutive vertices as lie between two neighbours at most.
template <int D>
std::vector<Index> by_number(const Mesh<D>& mesh) {
  Index bandwidth = 1;
  for (const auto& e : mesh.elements) {
    const auto [least, most] = std::minmax_element(e.begin(), e.end());
    bandwidth = std::max(bandwidth, *most - *least);
  }
  std::vector<Index> layer(mesh.points.size());
  for (Index v = 0; v < mesh.vertices(); ++v) layer[v] = v / bandwidth;
  return layer;
}

/// Mean size of the layer that a vertex lies in, times the number of vertices.
double width(const std::vector<Index>& layer) {
  std::vector<double> size;
  for (const Index l : layer) {
    if (static_cast<std::size_t>(l) >= size.size()) size.resize(static_cast<std::size_t>(l) + 1, 0);
    ++size[l];
  }
  double sum = 0;
  for (const double s : size) sum += s * s;
  return sum;
}

}  // namespace

template <int D>
std::vector<Index> layers(const Mesh<D>& mesh) {
  std::vector<Index> numbered = by_number(mesh), distant = by_distance(neighbours(mesh), mesh.vertices());
  return width(numbered) <= width(distant) ? numbered : distant;
}

template std::vector<Index> layers(const Mesh<2>&);
template std::vector<Index> layers(const Mesh<3>&);

}  // namespace signorini
