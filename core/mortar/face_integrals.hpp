#pragma once
#include <vector>

#include "core/mortar/dual_basis.hpp"
#include "core/mortar/element_face.hpp"
#include "core/mortar/nearest_sheet.hpp"
#include "core/mortar/segments.hpp"

namespace signorini::mortar {

/// What one slave face, of an element of order P, sees.
template <int D, int P>
struct FaceRecord {
  static constexpr std::size_t nodes = ElementFace<D, P>::nodes;

  std::array<Index, nodes> node;              ///< among those of the slave
  std::array<double, nodes> share;            ///< ∫ ψ_p over the slave
  std::array<double, nodes> gap;              ///< ∫ ψ_p (distance) over ∫ ψ_p
  double nearest, farthest;                   ///< of the distances themselves
  double size;                                ///< of the face
  double kink;                                ///< see MortarCoupling; zero where `gap` is not beyond them
  bool of_surface;                            ///< distances are along the normals of what the face stands for
  std::array<Point<D>, nodes> normal;         ///< as gap, of what the distance is measured along; then those at nodes
  std::size_t first = 0, last = 0;            ///< its entries
  std::size_t first_part = 0, last_part = 0;  ///< of the master in front of it, partners or not
};

/// ∫ ψ_p φ_q over ∫ ψ_p for the nodes p of a slave face.
template <int D, int P>
struct FaceEntry {
  Index master;  ///< q, among the nodes of the master
  std::array<double, ElementFace<D, P>::nodes> value;
};

/// What consecutive slave faces see.
template <int D, int P>
struct FaceIntegrals {
  std::vector<FaceRecord<D, P>> records;  ///< of the faces that see the master
  std::vector<FaceEntry<D, P>> entries;
  std::vector<SeenPart> parts;
  DeepestOverlap<D> deepest;
  Index lumped = 0, layered = 0;
};

/// Computes them, face by face.
template <int D, int P>
class FaceIntegrator {
 public:
  /// Parameters as of SegmentFinder.
  /// @param creases of the master
  FaceIntegrator(const Side<D>& slave, const Creases<D>& creases, const Planes<D>& own, const Planes<D>& planes,
                 const PointTree<D>& tree, const CoupleOptions& options, bool one_numbering)
      : slave_(slave),
        master_(creases.side()),
        along_normals_(options.pairing == Pairing::normal),
        axisymmetric_(options.axisymmetric),
        added_gap_(options.added_gap),
        finder_(slave, master_, own, planes, tree, options, one_numbering),
        place_(master_.node.size(), std::size_t{0}),
        sheet_(creases) {}

  void add(ElementFace<D, P> face, FaceIntegrals<D, P>& to);

 private:
  static constexpr int K = D - 1;
  using Barycentric = std::array<double, D>;
  using NodeNormals = std::array<Point<D>, ElementFace<D, P>::nodes>;

  /// A point of the slave, as CoveredPoint, and what is in front of it.
  struct Seen {
    Barycentric master;  ///< coordinates in the master's face
    double gap;
    Point<D> normal;
  };
  /// Points one after the other in front of one part of a face of the master.
  struct Run {
    Index part;
    std::size_t first, last;
    Distances seen;
    double measure;  ///< of the slave
  };

  void look(ElementFace<D, P> face, Index child, FaceIntegrals<D, P>& to);
  void add_points(const Segment<D>& segment, ElementFace<D, P> face, Index child, const ElementMap<D, K, P>& slave,
                  double scale);
  NodeNormals normals_at_nodes(ElementFace<D, P> face) const;
  double added(Index part, const Point<K>& y) const;
  double distance(const Segment<D>& segment, Index part, const Point<K>& y) const;
  Distances note_overlap(const Segment<D>& segment, Index part, DeepestOverlap<D>& deepest) const;
  void keep_nearest_sheet(const Point<D>& direction, double size);
  double kink(ElementFace<D, P> face, double size) const;
  FaceEntry<D, P>& entry(Index point, FaceIntegrals<D, P>& to);

  const Side<D>& slave_;
  const Side<D>& master_;
  const bool along_normals_, axisymmetric_;
  const std::span<const double> added_gap_;
  SegmentFinder<D> finder_;
  std::vector<std::size_t> place_;  // per node of the master that of its entry; of no meaning outside the record's
  std::vector<CoveredPoint<K>> covered_;
  std::size_t surface_points_ = 0;  // of these, see FaceRecord::of_surface
  std::vector<Seen> seen_;          // per point
  std::vector<Run> runs_;
  std::vector<SeenPart> parts_;  // of the master, ascending
  NearestSheet<D> sheet_;
};

}  // namespace signorini::mortar
