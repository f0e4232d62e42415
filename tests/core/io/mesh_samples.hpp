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
