// Layers keep the bandwidth of refined meshes small, whatever the numbering of the coarsest one.
#include "core/mesh/layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "core/mesh/refine.hpp"
#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

template <int D>
Mesh<D> renumbered(Mesh<D> mesh) {
  std::vector<Index> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(7));
  const std::vector<Point<D>> points = mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) mesh.points[number[v]] = points[v];
  for (auto& e : mesh.elements)
    for (Index& v : e) v = number[v];
  for (auto& face : mesh.boundary)
    for (Index& v : face.vertices) v = number[v];
  return mesh;
}

template <int D>
Index largest_step(const Mesh<D>& mesh, const std::vector<Index>& number) {
  Index step = 0;
  for (const auto& e : mesh.elements)
    for (const Index v : e)
      for (const Index w : e) step = std::max(step, number[v] - number[w]);
  return step;
}

template <int D>
Index bandwidth(const Mesh<D>& mesh) {
  std::vector<Index> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  return largest_step(mesh, number);
}

template <int D>
void expect_layers(const Mesh<D>& coarsest, Index at_least) {
  const std::vector<Index> layer = layers(coarsest);
  EXPECT_EQ(largest_step(coarsest, layer), 1);
  EXPECT_GE(*std::ranges::max_element(layer), at_least - 1);
  EXPECT_EQ(*std::ranges::min_element(layer), 0);
  const MeshHierarchy<D> h = hierarchy(coarsest, D == 2 ? 5 : 3);
  for (std::size_t k = 1; k < h.levels.size(); ++k)
    EXPECT_LE(largest_step(h.levels[k], h.levels[k].layer), 2) << "an inner diagonal goes over two layers";
  std::vector<Index> size;
  for (const Index l : h.finest().layer) {
    size.resize(std::max(size.size(), static_cast<std::size_t>(l) + 1), 0);
    ++size[l];
  }
  EXPECT_LE(bandwidth(h.finest()), 4 * *std::ranges::max_element(size));
}

TEST(Layers, FollowTheNumberingOfStructuredMeshes) {
  expect_layers(rectangle({0, 0}, {1, 1}, {6, 6}), 6);
  expect_layers(box({0, 0, 0}, {1, 1, 1}, {4, 4, 4}), 4);
}

TEST(Layers, AreFoundWhateverTheNumbering) {
  expect_layers(renumbered(rectangle({0, 0}, {6, 1}, {30, 5})), 30);
  expect_layers(renumbered(box({0, 0, 0}, {1, 1, 4}, {2, 2, 8})), 8);
}

TEST(Layers, OfPartsThatDoNotTouch) {
  Mesh<2> two = rectangle({0, 0}, {1, 1}, {4, 4});
  const Mesh<2> other = rectangle({2, 0}, {3, 1}, {4, 4});
  const Index first = two.vertices();
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  for (auto e : other.elements) {
    for (Index& v : e) v += first;
    two.elements.push_back(e);
  }
  expect_layers(renumbered(two), 8);
}

}  // namespace
}  // namespace signorini
