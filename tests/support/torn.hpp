#pragma once
#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "core/fem/elements/element.hpp"
#include "core/fem/elements/nodes.hpp"

/// Meshes whose nodes are not their vertices: torn apart, and glued together by nodes that are numbered at random.
namespace signorini::test {

/// The same mesh with elements on either side of the plane x = `middle` that have no vertex in common. Its boundary is
/// that of the whole one: the faces along the tear are no part of it.
template <int D>
Mesh<D> torn(const Mesh<D>& whole, double middle) {
  Mesh<D> out = whole;
  std::map<Index, Index> twin;
  const auto is_right = [&](std::size_t e) { return centroid<D>(whole, whole.elements[e])[0] > middle; };
  const auto tear = [&](Index& v) {
    if (whole.points[v][0] != middle) return;
    const auto [entry, is_new] = twin.try_emplace(v, out.vertices());
    if (is_new) out.points.push_back(whole.points[v]);
    v = entry->second;
  };
  for (std::size_t e = 0; e < out.elements.size(); ++e)
    if (is_right(e)) std::ranges::for_each(out.elements[e], tear);
  for (Face<D>& face : out.boundary)
    if (is_right(static_cast<std::size_t>(face.element))) std::ranges::for_each(face.vertices, tear);
  return out;
}

/// A number for each vertex, at random, the same for those at one place.
template <int D>
std::vector<Index> glued_at_random(const Mesh<D>& mesh) {
  std::map<Point<D>, Index> place;
  for (const Point<D>& x : mesh.points) place.try_emplace(x, static_cast<Index>(place.size()));
  std::vector<Index> random(place.size()), out;
  std::iota(random.begin(), random.end(), 0);
  std::ranges::shuffle(random, std::mt19937(5));
  for (const Point<D>& x : mesh.points) out.push_back(random[place[x]]);
  return out;
}

template <int D>
std::vector<Nodes<D>> glued_at_random(const MeshHierarchy<D>& hierarchy) {
  std::vector<Nodes<D>> out;
  for (const Mesh<D>& mesh : hierarchy.levels) out.emplace_back(mesh, glued_at_random(mesh));
  return out;
}

/// Per vertex of `whole` the node at its place.
template <int D>
std::vector<Index> nodes_at(const Mesh<D>& whole, const Nodes<D>& nodes) {
  std::map<Point<D>, Index> place;
  for (Index p = 0; p < nodes.size(); ++p) place[nodes.at(p)] = p;
  std::vector<Index> out;
  for (const Point<D>& x : whole.points) out.push_back(place.at(x));
  return out;
}

}  // namespace signorini::test
