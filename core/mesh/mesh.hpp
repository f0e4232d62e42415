#pragma once
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// A named set of boundary faces. Parts may overlap (physical groups do).
struct Part {
  std::string name;
  std::vector<Index> faces;
};

/// A circle (D = 2), a sphere (D = 3) or a cylinder along z (D = 3, `along_z`), on which curved boundary faces lie.
template <int D>
struct Curve {
  Point<D> center{};
  double radius = 0;
  bool along_z = false;
};

/// A boundary face, vertices ordered so that its normal points outwards.
template <int D>
struct Face {
  std::array<Index, D> vertices;
  Index element;     ///< the element it bounds
  Index curve = -1;  ///< index into Mesh::curves, or -1 where it is flat
};

/// The vertices of an element and the midpoints of its edges, in the order of simplex_edges: the vertices of the
/// children that red refinement makes of the element, see RedRefinement.
template <int D>
using Family = std::array<Index, (D + 1) * (D + 2) / 2>;

/// One conforming simplicial mesh: D = 2 triangles, D = 3 tetrahedra.
template <int D>
struct Mesh {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D + 1>> elements;  ///< positively oriented
  std::vector<Face<D>> boundary;                   ///< every boundary face, once
  std::vector<Part> parts;                         ///< named parts; all faces together always answer to "boundary"
  std::vector<Curve<D>> curves;
  std::vector<Index> region;         ///< per element the material it is of, -1: the body's own; empty: all of them
  std::vector<Family<D>> families;   ///< all elements once more, as children; none where they are not
  std::vector<Index> family_region;  ///< per family, as `region`
  std::vector<Index> layer;          ///< per vertex, see core/mesh/layers.hpp; refined meshes are numbered by it
  int refinements = 0;               ///< uniform ones that made it from the coarsest mesh

  Index vertices() const { return static_cast<Index>(points.size()); }
};

/// How a mesh came out of the next coarser one. Each vertex of the fine mesh is a coarse vertex a, stored as {a, a},
/// or the midpoint of the coarse edge {a, b}. Local refinement with conforming closure needs nothing else.
struct Refinement {
  std::vector<std::array<Index, 2>> parents;  ///< per fine vertex
  std::vector<Index> father;                  ///< per fine element, the coarse element it lies in
  bool uniform = true;                        ///< every coarse edge is cut
};

/// Conforming meshes, coarsest first; refinements[k] leads from levels[k] to levels[k + 1].
template <int D>
struct MeshHierarchy {
  std::vector<Mesh<D>> levels;
  std::vector<Refinement> refinements;

  const Mesh<D>& finest() const { return levels.back(); }
};

}  // namespace signorini
