#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Faces given by their vertices in any order, as physical groups of mesh files are.
template <int D>
struct FaceGroup {
  std::string name;
  std::vector<std::array<Index, D>> faces;
};

/// The faces that belong to one element only, oriented outwards, in the order of the elements. Linear time.
template <int D>
std::vector<Face<D>> find_boundary(Index vertices, const std::vector<std::array<Index, D + 1>>& elements);

/// Adds each group as a part of `mesh`, whose boundary is known. Faces inside the mesh belong to no part; a group
/// without any boundary face becomes none. Groups of one name are joined.
template <int D>
void attach_parts(Mesh<D>& mesh, const std::vector<FaceGroup<D>>& groups);

/// Takes faces out of the boundary of a coarsest mesh, and out of its parts.
/// @param kept per boundary face
template <int D>
void keep_faces(Mesh<D>& mesh, const std::vector<bool>& kept);

/// The numbers of the boundary faces of a part in ascending order. "boundary" is all of them unless a part has that
/// name. An unknown name is an Error(Exit::input) at `place` with the nearest name and the list of parts.
template <int D>
std::vector<Index> faces_of(const Mesh<D>& mesh, std::string_view name, std::string_view place);

/// The boundary faces that uniform refinement makes of one of the coarsest mesh; its children are numbered together.
template <int D>
Index faces_per_coarsest(const Mesh<D>& mesh) {
  return Index{1} << ((D - 1) * mesh.refinements);
}

/// The vertices, on this mesh, of boundary face number `coarsest` of the coarsest one, which refinement leaves in
/// place.
template <int D>
std::array<Index, D> coarsest_face(const Mesh<D>& mesh, Index coarsest);

/// The corners of a boundary face in barycentric coordinates of the face of the coarsest mesh that it is a part of.
/// @param face its number after so many uniform refinements
template <int D>
std::array<std::array<double, D>, D> in_coarsest_face(Index face, int refinements);

}  // namespace signorini
