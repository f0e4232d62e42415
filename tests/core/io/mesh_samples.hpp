#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini::test {

/// A mesh as a file holds it: blocks of cells of one geometric entity.
struct SampleBlock {
  int dimension;
  int tag;
  std::vector<int> physicals;
  std::vector<std::vector<Index>> cells;
};
struct Sample {
  std::vector<Point<3>> points;
  std::vector<SampleBlock> blocks;
  std::map<std::pair<int, int>, std::string> names;
};

/// Parts become entities in the groups 1, 2, ...; only the odd ones have names. The first part is in group 9, too.
template <int D>
Sample sample_of(const Mesh<D>& mesh) {
  Sample sample;
  for (const auto& p : mesh.points) sample.points.push_back({p[0], p[1], D == 3 ? p[D - 1] : 0.5});
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    const int tag = static_cast<int>(k) + 1;
    SampleBlock block{D - 1, 10 + tag, {tag}, {}};
    if (k == 0) block.physicals.push_back(9);
    if (k % 2 == 0) sample.names[{D - 1, tag}] = mesh.parts[k].name;
    for (const Index f : mesh.parts[k].faces) {
      const auto& v = mesh.boundary[f].vertices;
      block.cells.emplace_back(v.begin(), v.end());
    }
    sample.blocks.push_back(block);
  }
  SampleBlock body{D, 1, {5, 6}, {}};
  for (const auto& element : mesh.elements) body.cells.emplace_back(element.begin(), element.end());
  sample.blocks.push_back(body);
  sample.names[{D, 5}] = "the body";
  return sample;
}

/// The sample with second-order cells: a node on every edge where `middle` puts it, edges in the order of Gmsh or VTK
/// (the nodes 8 and 9 of tetrahedra change places).
template <class Middle>
Sample second_order(Sample sample, const Middle& middle, bool vtk) {
  std::map<std::pair<Index, Index>, Index> between;
  const auto node = [&](Index a, Index b) {
    const auto [entry, is_new] = between.try_emplace(std::minmax(a, b), static_cast<Index>(sample.points.size()));
    if (is_new) sample.points.push_back(middle(sample.points[a], sample.points[b]));
    return entry->second;
  };
  for (SampleBlock& block : sample.blocks)
    for (auto& cell : block.cells) {
      std::vector<std::pair<int, int>> edges{{0, 1}};
      if (block.dimension >= 2) edges.insert(edges.end(), {{1, 2}, {2, 0}});
      if (block.dimension == 3) edges.insert(edges.end(), {{3, 0}, {3, 2}, {3, 1}});
      if (block.dimension == 3 && vtk) std::swap(edges[4], edges[5]);
      const std::vector<Index> corners = cell;
      for (const auto& [a, b] : edges) cell.push_back(node(corners[a], corners[b]));
    }
  return sample;
}

/// Numbers as bytes of either order.
class ByteWriter {
 public:
  explicit ByteWriter(bool swapped = false) : swapped_(swapped) {}

  template <class T>
  void add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (swapped_) std::reverse(bytes, bytes + sizeof(T));
    out.append(bytes, sizeof(T));
  }

  std::string out;

 private:
  bool swapped_;
};

}  // namespace signorini::test
