#include "core/mesh/families.hpp"

#include <algorithm>
#include <new>
#include <numeric>

#include "core/base/release.hpp"
#include "core/mesh/red_refinement.hpp"

namespace signorini {
namespace {

constexpr double least = 0.05;

template <int D>
constexpr auto edges = simplex_edges<D>();

/// By how much a midpoint is off the middle.
template <int D>
Point<D> bend(const Mesh<D>& mesh, const Family<D>& family, std::size_t k) {
  const auto [a, b] = edges<D>[k];
  return difference<D>(mesh.points[family[D + 1 + k]], midpoint<D>(mesh.points[family[a]], mesh.points[family[b]]));
}

/// The smallest determinant at a node, relative to that of the flat element.
template <int D>
double least_determinant(const Mesh<D>& mesh, const Family<D>& family) {
  std::array<Point<D>, edges<D>.size()> bends;
  bool curved = false;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    bends[k] = bend(mesh, family, k);
    curved = curved || bends[k] != Point<D>{};
  }
  if (!curved) return 1;
  std::array<Point<D>, D> flat;
  for (int i = 0; i < D; ++i) flat[i] = difference<D>(mesh.points[family[i + 1]], mesh.points[family[0]]);
  const double whole = determinant<D>(flat);
  double smallest = infinity;
  for (std::size_t node = 0; node < family.size(); ++node) {
    std::array<double, D + 1> x{};
    if (node <= D)
      x[node] = 1;
    else
      for (const int end : edges<D>[node - D - 1]) x[end] = 0.5;
    std::array<Point<D>, D + 1> by{};  // derivatives by barycentric coordinates, of the bends
    for (std::size_t k = 0; k < bends.size(); ++k)
      for (int i = 0; i < D; ++i) {
        by[edges<D>[k][0]][i] += 4 * x[edges<D>[k][1]] * bends[k][i];
        by[edges<D>[k][1]][i] += 4 * x[edges<D>[k][0]] * bends[k][i];
      }
    auto map = flat;
    for (int row = 0; row < D; ++row)
      for (int i = 0; i < D; ++i) map[row][i] += by[row + 1][i] - by[0][i];
    smallest = std::min(smallest, determinant<D>(map) / whole);
  }
  return smallest;
}

}  // namespace

template <int D>
std::vector<Index> straighten_families(Mesh<D>& mesh) {
  std::vector<Index> straightened;
  for (bool settled = false; !settled;) {
    settled = true;
    for (const Family<D>& family : mesh.families) {
      if (least_determinant(mesh, family) >= least) continue;
      for (std::size_t k = 0; k < edges<D>.size(); ++k) {
        if (bend(mesh, family, k) == Point<D>{}) continue;
        const auto [a, b] = edges<D>[k];
        mesh.points[family[D + 1 + k]] = midpoint<D>(mesh.points[family[a]], mesh.points[family[b]]);
        straightened.push_back(family[D + 1 + k]);
        settled = false;
      }
    }
  }
  return straightened;
}

namespace {

/// Calls visit(family, child, lowest layer) for the children of all families.
template <int D, class Visit>
void for_each_child(const Mesh<D>& mesh, const Visit& visit) {
  for (const Family<D>& family : mesh.families) {
    Family<D> layer;
    for (std::size_t i = 0; i < family.size(); ++i) layer[i] = mesh.layer[family[i]];
    for (const auto& child : RedRefinement<D>::children) {
      Index lowest = layer[child[0]];
      for (const int i : child) lowest = std::min(lowest, layer[i]);
      visit(family, child, static_cast<std::size_t>(lowest));
    }
  }
}

}  // namespace

template <int D>
std::vector<Simplex<D>> elements_of_families(const Mesh<D>& mesh) {
  if (mesh.families.empty()) return {};
  std::vector<std::size_t> next(static_cast<std::size_t>(*std::ranges::max_element(mesh.layer)) + 2, 0);
  for_each_child(mesh, [&](const auto&, const auto&, std::size_t lowest) { ++next[lowest + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Simplex<D>> out(mesh.families.size() * RedRefinement<D>::children.size());
  for_each_child(mesh, [&](const Family<D>& family, const auto& child, std::size_t lowest) {
    Simplex<D>& element = out[next[lowest]++];
    for (int a = 0; a <= D; ++a) element[a] = family[child[a]];
  });
  return out;
}

namespace {

/// Where a vertex of a refined mesh is while no curved surface has moved it.
template <int D>
Point<D> halfway(const Mesh<D>& coarse, const std::array<Index, 2>& parents) {
  const auto [a, b] = parents;
  return a == b ? coarse.points[a] : midpoint<D>(coarse.points[a], coarse.points[b]);
}

/// Whether the coarser mesh knows all points of a refined one, to the last bit.
template <int D>
bool halves_edges(const Mesh<D>& coarse, const Refinement& refinement, const Mesh<D>& fine) {
  for (std::size_t v = 0; v < fine.points.size(); ++v)
    if (fine.points[v] != halfway(coarse, refinement.parents[v])) return false;
  return true;
}

template <int D>
void restore_points(MeshHierarchy<D>& meshes) {
  for (std::size_t k = 1; k < meshes.levels.size(); ++k) {
    if (!meshes.levels[k].points.empty()) continue;
    std::vector<Point<D>> points;
    points.reserve(meshes.refinements[k - 1].parents.size());
    for (const auto& parents : meshes.refinements[k - 1].parents)
      points.push_back(halfway(meshes.levels[k - 1], parents));
    meshes.levels[k].points = std::move(points);
  }
}

template <int D>
void restore(Mesh<D>& mesh) {
  if (mesh.elements.empty()) mesh.elements = elements_of_families(mesh);
}

}  // namespace

template <int D>
void restore_elements(MeshHierarchy<D>& meshes) {
  restore_points(meshes);
  for (Mesh<D>& mesh : meshes.levels) restore(mesh);
}

template <int D>
void restore_ends(MeshHierarchy<D>& meshes) {
  restore_points(meshes);
  restore(meshes.levels.back());
  restore(meshes.levels.front());
}

template <int D>
ElementsAside<D>::ElementsAside(MeshHierarchy<D>& meshes) : meshes_(meshes) {
  for (Mesh<D>& mesh : meshes_.levels)
    if (!mesh.families.empty()) release(mesh.elements);
  for (std::size_t k = meshes_.levels.size(); k-- > 1;)
    if (halves_edges(meshes_.levels[k - 1], meshes_.refinements[k - 1], meshes_.levels[k]))
      release(meshes_.levels[k].points);
}

template <int D>
ElementsAside<D>::~ElementsAside() {
  try {
    restore_ends(meshes_);
  } catch (const std::bad_alloc&) {
  }
}

#define SIGNORINI_INSTANTIATE(D)                                         \
  template std::vector<Index> straighten_families(Mesh<D>&);             \
  template void restore_elements(MeshHierarchy<D>&);                     \
  template void restore_ends(MeshHierarchy<D>&);                         \
  template std::vector<Simplex<D>> elements_of_families(const Mesh<D>&); \
  template class ElementsAside<D>
SIGNORINI_INSTANTIATE(2);
SIGNORINI_INSTANTIATE(3);
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
