#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/model/model.hpp"
#include "core/fem/pairs/overlap.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mortar/couple.hpp"

namespace signorini {

/// The numbers of the faces that an obstacle between two bodies picks of each.
struct PairedFaces {
  std::vector<Index> slave, master;
};

/// Error(Exit::input) for a face that is picked twice, as where a body touches itself.
template <int D>
PairedFaces paired_faces(const Mesh<D>& mesh, const ObstacleTerm<D>& term, double t);

/// Whether both sides are of the same body.
template <int D>
bool of_one_body(const ObstacleTerm<D>& term);

/// The faces of the body that a selection is of, ascending.
template <int D>
std::vector<Index> faces_of_body(const Mesh<D>& mesh, const Selection& some, double t);

/// Vertices of faces that obstacles act on which are none between bodies.
template <int D>
std::vector<Index> of_other_obstacles(const Mesh<D>& mesh, const Model<D>& model);

/// How deep the bodies of an obstacle overlap; nothing where these are one and the same.
/// @param points where the vertices of the mesh are
/// @param added see find_overlap()
template <int D>
std::optional<Overlap<D>> overlap_of_sides(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& sides,
                                           double t, std::span<const Point<D>> points,
                                           const std::function<double(const Point<D>&, Index)>& added = {});

/// The same at the start, less what the obstacle adds to their distance.
template <int D>
std::optional<Overlap<D>> start_overlap(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& sides,
                                        double t);

/// What the obstacle adds to the distance of the bodies at a place of one of the slave's faces.
template <int D>
double added_on_face(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const Point<D>& place, Index slave_face);

/// The sides of one of a model's obstacles between two bodies, coupled. They see each other from anywhere, but not
/// through a body, as a face and the one on its back would: not deeper than the bodies overlap, two of one body not
/// deeper than an element of the coarsest mesh. Its nodes are vertices of the mesh.
/// @param points where the vertices of the mesh are; none: as the mesh has them
/// @param left_out see CoupleOptions
template <int D>
MortarCoupling<D> couple_sides(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                               const std::vector<Index>& slave, const std::vector<Index>& master,
                               std::span<const Point<D>> points = {}, std::span<const Index> left_out = {});

/// The same without some vertices of the slave, ascending, whose share is their neighbours'; but for faces of elements
/// all of whose vertices are such.
template <int D>
MortarCoupling<D> couple_beside(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                                const PairedFaces& faces, std::span<const Point<D>> points,
                                const std::vector<Index>& left_out);

/// The same where all of the jump counts, as with friction. What a fix prescribes at a node of the slave no unknown
/// there is a jump along, and no friction could act on the master. Such nodes are left out, too, but for nodes in front
/// of which the master is prescribed to go along with them, as where fixes stand for a plane of symmetry.
/// @param lost gets at how many nodes friction along something is lost all the same; null: not asked
template <int D>
MortarCoupling<D> couple_whole_jumps(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                                     const PairedFaces& faces, const std::vector<FixedDirections<D>>& fixes,
                                     std::span<const Point<D>> points = {}, const std::vector<Index>& left_out = {},
                                     Index* lost = nullptr);

/// Error(Exit::input) for bodies that overlap at the start, and of which no faces see that: they would pass through
/// each other.
/// @param nodes of the finest mesh: on coarser ones chords may overlap
template <int D>
void refuse_unseen_overlap(const Nodes<D>& nodes, const Model<D>& model);

/// The vertices of the mesh displaced by u, D per node.
template <int D>
std::vector<Point<D>> displaced_points(const Nodes<D>& nodes, const std::vector<double>& u);

/// The sides of a model's obstacle between two bodies where u, D per node, takes them.
template <int D>
MortarCoupling<D> couple_displaced(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                   const std::vector<double>& u);

/// The normal of a slave's node where some of its displacement is prescribed: contact acts along what is left of it.
/// (On a plane of symmetry the mean normal of a curved surface is inclined, for faces are on one side only.)
template <int D>
struct FreeNormal {
  Point<D> direction;     ///< of length 1
  double part = 1;        ///< of the whole normal along it
  double prescribed = 0;  ///< how far the node is moved along the whole normal by what is prescribed
};

/// Nothing where the displacement along the normal is prescribed.
template <int D>
std::optional<FreeNormal<D>> free_normal(const std::vector<FixedDirections<D>>& fixes, Index node,
                                         const Point<D>& normal);

/// What is prescribed at a node; null: nothing.
template <int D>
const FixedDirections<D>* fixed_at(const std::vector<FixedDirections<D>>& fixes, Index node);

/// How far the displacement of a node along a direction is prescribed to be; nothing where it is not.
template <int D>
std::optional<double> prescribed_along(const std::vector<FixedDirections<D>>& fixes, Index node,
                                       const double* direction);

/// Of a face.
template <int D>
double longest_edge(const Mesh<D>& mesh, const Face<D>& face);

}  // namespace signorini
