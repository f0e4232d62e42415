#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <vector>

#include "view.hpp"

namespace signorini::test {

/// A block by its cells, with the parts that shapes have: left, right, (front, back,) bottom, top.
template <int D>
struct Block {
  Point<D> from{}, to{};
  std::array<int, D> cells{};
};

template <int D>
const std::vector<std::string>& block_parts() {
  static const std::vector<std::string> names =
      D == 2 ? std::vector<std::string>{"left", "right", "bottom", "top"}
             : std::vector<std::string>{"left", "right", "front", "back", "bottom", "top"};
  return names;
}

/// Writes it as a mesh for Gmsh (2.2), each cell in D! simplices along its diagonal.
template <int D>
void write_block(const std::filesystem::path& file, const Block<D>& block, const View<D>& view) {
  using Cell = std::array<int, D>;
  const auto number = [&](const Cell& at) {
    int n = 0;
    for (int i = D; i-- > 0;) n = n * (block.cells[i] + 1) + at[i];
    return n + 1;
  };
  std::string nodes, elements;
  int node_count = 0, element_count = 0;
  const auto each = [&](const Cell& end, auto&& visit) {
    Cell at{};
    for (int i = 0; i < D;) {
      if (i == 0) visit(at);
      if (++at[i] < end[i])
        i = 0;
      else
        at[i++] = 0;
    }
  };
  Cell ends = block.cells;
  for (int& n : ends) ++n;
  each(ends, [&](const Cell& at) {
    Point<D> x;
    for (int i = 0; i < D; ++i) x[i] = block.from[i] + (block.to[i] - block.from[i]) * at[i] / block.cells[i];
    x = view.place(x);
    nodes += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", number(at), x[0], x[1], D == 3 ? x[D - 1] : 0.0);
    ++node_count;
  });
  const auto add = [&](int type, int group, const std::vector<int>& vertices) {
    elements += fmt::format("{} {} 2 {} {} {}\n", ++element_count, type, group, group, fmt::join(vertices, " "));
  };
  each(block.cells, [&](const Cell& cell) {
    std::array<int, D> order;
    std::iota(order.begin(), order.end(), 0);
    do {
      std::vector<Cell> corners{cell};
      for (const int axis : order) {
        corners.push_back(corners.back());
        ++corners.back()[axis];
      }
      int inversions = 0;
      for (int i = 0; i < D; ++i)
        for (int j = i + 1; j < D; ++j) inversions += order[i] > order[j];
      std::vector<int> vertices;
      for (const Cell& c : corners) vertices.push_back(number(c));
      if (inversions % 2 == 1) std::swap(vertices[D - 1], vertices[D]);
      add(D == 2 ? 2 : 4, 2 * D + 1, vertices);
      for (int axis = 0; axis < D; ++axis)
        for (const int side : {0, 1}) {
          std::vector<int> face;
          for (const Cell& c : corners)
            if (c[axis] == side * block.cells[axis]) face.push_back(number(c));
          if (face.size() == D) add(D == 2 ? 1 : 2, 2 * axis + side + 1, face);
        }
    } while (std::next_permutation(order.begin(), order.end()));
  });
  std::ofstream out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << 2 * D + 1 << '\n';
  for (int k = 0; k < 2 * D; ++k) out << D - 1 << ' ' << k + 1 << " \"" << block_parts<D>()[k] << "\"\n";
  out << D << ' ' << 2 * D + 1 << " \"all\"\n$EndPhysicalNames\n$Nodes\n" << node_count << '\n' << nodes;
  out << "$EndNodes\n$Elements\n" << element_count << '\n' << elements << "$EndElements\n";
}

}  // namespace signorini::test
