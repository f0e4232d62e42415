#pragma once
#include <vector>

#include "core/mortar/segments.hpp"

namespace signorini::mortar {

/// What one slave face sees.
template <int D>
struct FaceRecord {
  Index face;
  Point<D> direction;
  std::array<double, D> share;  ///< ∫ ψ_p over the slave
  std::array<double, D> gap;    ///< ∫ ψ_p (distance) over ∫ ψ_p
  std::size_t first, last;      ///< its entries
};

/// ∫ ψ_p φ_q over ∫ ψ_p for the D nodes p of a slave face.
template <int D>
struct FaceEntry {
  Index master;  ///< q, among the nodes of the master
  std::array<double, D> value;
};

/// What consecutive slave faces see.
template <int D>
struct FaceIntegrals {
  std::vector<FaceRecord<D>> records;  ///< of the faces that see the master
  std::vector<FaceEntry<D>> entries;
  DeepestOverlap<D> deepest;
  Index lumped = 0, layered = 0;
};

/// Computes them, face by face.
template <int D>
class FaceIntegrator {
 public:
  /// Parameters as of SegmentFinder.
  FaceIntegrator(const Side<D>& slave, const Side<D>& master, const PointTree<D>& tree, const CoupleOptions& options,
                 bool one_numbering)
      : slave_(slave),
        master_(master),
        finder_(slave, master, tree, options, one_numbering),
        place_(master.node.size(), std::size_t{0}) {}

  void add(Index face, FaceIntegrals<D>& to);

 private:
  void note_overlap(Index face, DeepestOverlap<D>& deepest) const;
  FaceEntry<D>& entry(Index point, FaceIntegrals<D>& to);

  const Side<D>& slave_;
  const Side<D>& master_;
  SegmentFinder<D> finder_;
  std::vector<std::size_t> place_;  // per node of the master that of its entry; of no meaning outside the record's
};

}  // namespace signorini::mortar
