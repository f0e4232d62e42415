#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/crew.hpp"
#include "core/base/types.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mortar/pairing.hpp"

namespace signorini {

/// One side of a contact: faces, segments (D = 2) or triangles (D = 3). Those of quadratic elements are cut into
/// 2^(D-1) each, which follow each other as RedRefinement has them; their nodes are the corners of these.
template <int D>
struct SurfaceFaces {
  std::span<const Point<D>> points;                  ///< of the whole mesh; only those that faces name are looked at
  std::span<const std::array<Index, D>> faces = {};  ///< by numbers of points, the normal pointing outwards
  std::string_view place = "surface";                ///< what messages call it
  int order = 1;                                     ///< of the elements: 1 or 2
  /// What the faces stand for: the same ones there, undeformed, by their numbers in its boundary. None: themselves.
  const Mesh<D>* undeformed = nullptr;
  std::span<const Index> number = {};
};

struct CoupleOptions {
  Pairing pairing = Pairing::normal;
  double reach = 0;               ///< faces farther apart do not see each other; the user's unit of length
  std::optional<double> depth{};  ///< how deep an overlap is looked for; none: `reach`
  /// A node that the master covers less than this part of its area of is left alone; with quadratic elements at least
  /// less than a tenth.
  double least_cover = 1e-10;
  bool axisymmetric = false;  ///< the first coordinate is the radius of bodies of revolution (D = 2)
  /// Per point what counts as more distance of the slave there, in between linearly; of what comes out only the deepest
  /// overlap does. None: nothing.
  std::span<const double> added_gap{};
  /// Points of the slave, ascending, that are to be no slave nodes: what they are a part of goes to the other nodes of
  /// their faces, as far as these have any.
  std::span<const Index> left_out{};
};

/// Where slave and master overlap most.
template <int D>
struct DeepestOverlap {
  double depth = 0;  ///< 0: nowhere
  Point<D> place{};  ///< on the slave
  Index slave_face = -1, master_face = -1;
};

/// Two surfaces coupled by a mortar method with dual basis functions ψ on the slave. Per slave node p
///
///     ∫ ψ_p (u_S − u_M) = D_p (u_p − sum over q of M̂_pq u_q)
///
/// where the integral is over what the master covers of the slave, and q are nodes of the master. Rows of M̂ sum to one.
/// A force λ_p D_p on slave node p has −λ_p D_p M̂_pq on master node q as its counterpart. Not to overlap is, to first
/// order, n_p'(u_p − sum M̂_pq u_q) <= gap_p.
///
/// With quadratic elements u are coefficients, whose basis functions have positive means (midpoint_weight), and so are
/// gaps. Where the master covers less than about half of a quadratic face the mean of a corner's function over that is
/// negative. A node whose D_p is not a tenth of what it is where all of it is covered is left alone, and what it is a
/// part of goes to the face's other nodes: it is among their q then, with a weight of the other sign, and gap_p is that
/// of all of them: no mean any more. So it is with nodes that are left out, of elements of any order.
template <int D>
struct MortarCoupling {
  std::vector<Index> node;      ///< slave nodes with a partner, ascending; what follows is per entry of it
  std::vector<double> weight;   ///< D_p = ∫ ψ_p = ∫ φ_p over what is covered; positive
  std::vector<double> covered;  ///< D_p over the node's area in faces within 60 degrees of its normal
  std::vector<double> taken;    ///< the same of what it takes over of nodes that are left out
  /// Outer one of the slave, or against that of a plane before what is bent, see Planes: the mean over the node's faces
  /// as covered; of length 1.
  std::vector<Point<D>> normal;
  std::vector<double> gap;       ///< weak distance to the master along the normal; negative: overlap
  std::vector<double> nearest;   ///< least distance that faces of the node see, along its normal
  std::vector<double> farthest;  ///< and the largest: gap may be beyond both where the master covers less than a face
  std::vector<double> kink;      ///< as much gap may be beyond them by edges and ends of the master, see distance()
  std::vector<Offset> row{0};    ///< node.size() + 1: positions of the rows of M̂
  std::vector<Index> column;     ///< q, ascending in a row
  std::vector<double> value;

  std::vector<Index> alone;  ///< slave nodes without a partner, ascending
  DeepestOverlap<D> deepest;
  Index lumped = 0;   ///< slave faces covered in a strip so thin that ψ is of lower degree across it
  Index layered = 0;  ///< slave faces that see masters behind each other; the nearest counts

  Index nodes() const { return static_cast<Index>(node.size()); }
  /// The sum of a row's weights at nodes of the master: what the gap is the mean of has that factor in it.
  double part(Index p) const {
    double sum = 0;
    for (Offset k = row[p]; k < row[p + 1]; ++k) sum += is_own(column[k]) ? 0 : value[k];
    return sum;
  }
  /// The mean distance of a node. Dual functions are of both signs: where the distance has a kink within a face, as
  /// where an edge of the master comes down on it, or where an inclined master ends there, means by them are beyond all
  /// that is seen, by a part of the kink, which may be far more than bodies move. So far they are brought back to what
  /// is seen.
  double distance(Index p) const {
    const double mean = gap[p] / part(p);
    return mean + std::clamp(std::clamp(mean, nearest[p], farthest[p]) - mean, -kink[p], kink[p]);
  }
  /// Whether a q is a node of the slave.
  bool is_own(Index q) const { return std::ranges::binary_search(alone, q); }
};

/// Couples a slave to a master surface. Slave faces are cut exactly where edges of the master are, as seen along one
/// direction per slave face (Puso, Laursen: A mortar segment-to-segment contact method for large deformation solid
/// mechanics, 2004), so that all integrals are those of polynomials and exact. The ψ are biorthogonal to the trace
/// basis over what is covered of each slave face (Wohlmuth 2000; Cichosz, Bischoff: Consistent treatment of boundaries
/// with mortar contact formulations using dual Lagrange multipliers, 2011): rows of M̂ reproduce linear functions on
/// flat interfaces, overhanging ones included.
///
/// Distances and normals are those of the surfaces that faces stand for, shapes and patches, where a mesh says so
/// (core/mesh/true_surface.hpp): as they are off the undeformed faces they are off those here. Faces see each other
/// flat.
///
/// Faces pair whose normals are within 60 degrees of opposite; not through the master, out of which the way back from
/// the slave leads before. Where both surfaces have the same points (the same
/// memory), as parts of one body have, faces that share a node do not pair, and nodes of both are left alone.
///
/// A face, and the faces around a node, pair with the nearest sheet of the master, not with what falls back behind an
/// edge of that or lies behind a step of it: the integrals are over what the sheet covers
/// (core/mortar/nearest_sheet.hpp).
///
/// The result does not depend on the number of threads; on the order of nodes and faces by rounding only.
/// Work is linear in the number of faces, times a logarithm for the search.
/// Both sides have the same order.
/// Error(Exit::input) for a face with a node that does not exist or is not finite, or without area, and for options out
/// of range.
/// @param crew threads to share the work; none: the calling one
template <int D>
MortarCoupling<D> couple(const SurfaceFaces<D>& slave, const SurfaceFaces<D>& master, const CoupleOptions& options,
                         Crew* crew = nullptr);

}  // namespace signorini
