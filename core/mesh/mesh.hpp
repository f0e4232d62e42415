#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/mesh/cubic_patch.hpp"

namespace signorini {

/// A named set of boundary faces. Parts may overlap (physical groups do).
struct Part {
  std::string name;
  std::vector<Index> faces;
};

/// Shapes with a closed form, and what only the mesh knows.
enum class CurveKind {
  round,     ///< a circle (D = 2), a sphere (D = 3)
  cylinder,  ///< D = 3
  cone,      ///< D = 3
  torus,     ///< D = 3
  patches,   ///< a smooth surface through the vertices: see Mesh::patches
  elements,  ///< what the curved elements of the coarsest mesh make of their faces: see Mesh::bends
};

/// What curved boundary faces lie on.
template <int D>
struct Curve {
  using Kind = CurveKind;

  Point<D> center{};  ///< of a cylinder any point of the axis, of a cone its tip
  double radius = 0;  ///< of a torus that of the tube
  Kind kind = Kind::round;
  Point<D> axis{};    ///< of unit length; that of a cone points from the tip into it
  double second = 0;  ///< of a cone half the angle at its tip (radians), of a torus the radius of the tube's axis

  /// Whether it has a closed form.
  bool is_shape() const { return kind != Kind::patches && kind != Kind::elements; }
};

/// A boundary face, vertices ordered so that its normal points outwards.
template <int D>
struct Face {
  std::array<Index, D> vertices;
  Index element;          ///< the element it bounds
  Index curve = -1;       ///< index into Mesh::curves, or -1 where it is flat
  bool straight = false;  ///< at the word of a file: it has nodes in the middle of all edges, and these are straight
};

/// The vertices of an element and the midpoints of its edges, in the order of simplex_edges: the vertices of the
/// children that red refinement makes of the element, see RedRefinement.
template <int D>
using Family = std::array<Index, (D + 1) * (D + 2) / 2>;

/// What a smooth piece of the coarsest boundary is taken for; numbers in user's units.
struct SurfacePiece {
  std::string kind;      ///< plane, line, circle, sphere, cylinder, cone, torus, smooth, second order, facets
  Index faces = 0;       ///< of the coarsest mesh
  double deviation = 0;  ///< of vertices from a shape; of other kinds the largest distance from the flat faces
  double size = 0;       ///< diagonal of the box around it
  std::vector<double> center{}, axis{};  ///< of shapes, see Curve; empty where there is none
  double radius = 0, second = 0;         ///< likewise; of smooth pieces `second` is the largest angle smoothed over
};

/// By how much the midpoints of an element's edges are off the middle between their ends, in the order of
/// simplex_edges: those of the quadratic map that makes the element curved.
template <int D>
using Bends = std::array<Point<D>, D*(D + 1) / 2>;

/// A plane of symmetry: where coordinate `axis` is `at`.
struct Mirror {
  int axis = 0;
  double at = 0;
};

/// One conforming simplicial mesh: D = 2 triangles, D = 3 tetrahedra.
template <int D>
struct Mesh {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D + 1>> elements;  ///< positively oriented
  std::vector<Face<D>> boundary;                   ///< every boundary face, once
  std::vector<Part> parts;                         ///< named parts; all faces together always answer to "boundary"
  std::vector<Curve<D>> curves;
  /// Per boundary face of the coarsest mesh, for faces on curves of the kind `patches`; shared by all refinements of
  /// it.
  std::shared_ptr<const std::vector<CubicPatch<D>>> patches;
  std::vector<Bends<D>> bends;       ///< per element; empty: all are straight, or the mesh is not to be refined
  std::vector<SurfacePiece> pieces;  ///< of the coarsest mesh of a body whose geometry was looked for
  std::vector<Index> region;         ///< per element the material it is of, -1: the body's own; empty: all of them
  std::vector<Family<D>> families;   ///< all elements once more, as children; none where they are not
  std::vector<Index> family_region;  ///< per family, as `region`
  std::vector<Index> layer;          ///< per vertex, see core/mesh/layers.hpp; refined meshes are numbered by it
  int refinements = 0;               ///< uniform ones that made it from the coarsest mesh
  /// The mesh lies on one side of each and stands for the body with its mirror images; see core/mesh/mirror.hpp.
  std::vector<Mirror> mirrors;

  Index vertices() const { return static_cast<Index>(points.size()); }
};

/// How a mesh came out of the next coarser one. Each vertex of the fine mesh is a coarse vertex a, stored as {a, a},
/// or the midpoint of the coarse edge {a, b}. Local refinement with conforming closure needs nothing else.
struct Refinement {
  std::vector<std::array<Index, 2>> parents;  ///< per fine vertex
  std::vector<Index> father;                  ///< per fine element, the coarse element it lies in
  bool uniform = true;                        ///< every coarse edge is cut
  std::vector<Index> straightened;  ///< midpoints off the curve they belong to, where elements would be inverted
};

/// Conforming meshes, coarsest first; refinements[k] leads from levels[k] to levels[k + 1].
template <int D>
struct MeshHierarchy {
  std::vector<Mesh<D>> levels;
  std::vector<Refinement> refinements;
  std::vector<Point<D>> straightened;  ///< of all refinements, where they are

  const Mesh<D>& finest() const { return levels.back(); }
};

}  // namespace signorini
