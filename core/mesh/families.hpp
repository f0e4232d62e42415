#pragma once
#include "core/mesh/mesh.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {

/// Puts midpoints of edges into the middle between their ends again where a family, as a quadratic element, would be
/// turned inside out or nearly so: where its map's determinant at a node is less than a twentieth of the flat
/// element's.
/// @return which ones
template <int D>
std::vector<Index> straighten_families(Mesh<D>& mesh);

/// The elements of a refined mesh, in their order, as its families and the layers of its vertices tell them.
template <int D>
std::vector<Simplex<D>> elements_of_families(const Mesh<D>& mesh);

/// Gives refined meshes that are without elements or points theirs back.
template <int D>
void restore_elements(MeshHierarchy<D>& meshes);
/// The same, without the elements between the coarsest and the finest mesh.
template <int D>
void restore_ends(MeshHierarchy<D>& meshes);

/// Refined meshes know their elements twice, and where no curved surface has moved a vertex the coarser mesh knows all
/// points. While this lives they are known once, for whoever needs the memory and neither elements nor points.
/// Afterwards they are there again but for elements of meshes between the coarsest and the finest one, see
/// restore_ends(). Where there is no memory for them they are left out: the same tries again.
template <int D>
class ElementsAside {
 public:
  explicit ElementsAside(MeshHierarchy<D>& meshes);
  ~ElementsAside();
  ElementsAside(const ElementsAside&) = delete;
  ElementsAside& operator=(const ElementsAside&) = delete;

 private:
  MeshHierarchy<D>& meshes_;
};

}  // namespace signorini
