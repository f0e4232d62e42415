// The mesh of a forest's leaves.
#include "core/mesh/forest.hpp"

#include "core/mesh/bends.hpp"

namespace signorini {
namespace {

/// Of a leaf: that of the same quadratic map as its element of the coarsest mesh.
template <int D>
Bends<D> bends_within(const Bends<D>& whole, const std::array<std::array<double, D + 1>, D + 1>& corner) {
  constexpr auto edges = simplex_edges<D>();
  Bends<D> out;
  for (std::size_t k = 0; k < edges.size(); ++k) out[k] = bend_of<D>(whole, corner[edges[k][0]], corner[edges[k][1]]);
  return out;
}

}  // namespace

template <int D>
MadeMesh<D> Forest<D>::mesh() const {
  const Mesh<D>& coarsest = *coarsest_;
  MadeMesh<D> out;
  Mesh<D>& mesh = out.mesh;
  mesh.curves = coarsest.curves;
  mesh.pieces = coarsest.pieces;
  mesh.mirrors = coarsest.mirrors;
  for (const Part& part : coarsest.parts) mesh.parts.push_back({part.name, {}});
  std::vector<std::vector<Index>> parts_of(coarsest.boundary.size());
  for (std::size_t p = 0; p < coarsest.parts.size(); ++p)
    for (const Index f : coarsest.parts[p].faces) parts_of[f].push_back(static_cast<Index>(p));

  std::vector<CubicPatch<D>> patches;
  Barycentric<D - 1> on_faces(ids_);
  Barycentric<D> in_elements(ids_);
  std::vector<Index> number(points_.size(), -1);
  mesh.elements.reserve(leaf_.size());
  for (const Index node : leaf_) {
    const Bisected<D>& simplex = tree_[node].simplex;
    const Index root = tree_[node].root;
    Simplex<D> ids = simplex.vertex;
    std::array<Index, D + 1> face = simplex.face;
    if (simplex.mirrored) {
      flip<D>(ids);
      flip<D>(face);
    }
    Simplex<D> element;
    for (int i = 0; i <= D; ++i) {
      Index& v = number[ids[i]];
      if (v < 0) {
        v = mesh.vertices();
        mesh.points.push_back(points_[ids[i]]);
        out.id.push_back(ids[i]);
      }
      element[i] = v;
    }
    const auto e = static_cast<Index>(mesh.elements.size());
    mesh.elements.push_back(element);
    if (!coarsest.region.empty()) mesh.region.push_back(coarsest.region[root]);
    if (!coarsest.bends.empty()) {
      std::array<std::array<double, D + 1>, D + 1> corner;
      for (int i = 0; i <= D; ++i) corner[i] = in_elements.of(root, coarsest.elements[root], ids[i]);
      mesh.bends.push_back(bends_within<D>(coarsest.bends[root], corner));
    }
    for (int i = 0; i <= D; ++i) {
      if (face[i] < 0) continue;
      for (const Index p : parts_of[face[i]]) mesh.parts[p].faces.push_back(static_cast<Index>(mesh.boundary.size()));
      const Face<D>& whole = coarsest.boundary[face[i]];
      mesh.boundary.push_back({outward_face<D>(element, i), e, whole.curve, whole.straight});
      if (!coarsest.patches) continue;
      patches.emplace_back();
      if (whole.curve < 0 || coarsest.curves[whole.curve].kind != CurveKind::patches) continue;
      const auto vertex = outward_face<D>(ids, i);
      std::array<std::array<double, D>, D> corner;
      for (int k = 0; k < D; ++k) corner[k] = on_faces.of(face[i], whole.vertices, vertex[k]);
      patches.back() = (*coarsest.patches)[face[i]].part(corner);
    }
  }
  if (coarsest.patches) mesh.patches = std::make_shared<const std::vector<CubicPatch<D>>>(std::move(patches));
  return out;
}

template MadeMesh<2> Forest<2>::mesh() const;
template MadeMesh<3> Forest<3>::mesh() const;

}  // namespace signorini
