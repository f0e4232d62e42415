#pragma once
#include <algorithm>
#include <span>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/passes.hpp"

namespace signorini {

/// One level of the hierarchy: matrix, vectors, bounds and phases, all in local coordinates. On the finest level A, b
/// and x belong to the problem; on coarser ones x is a correction that starts from zero.
template <int B>
struct Level {
  Index vectors = 0;
  const BlockMatrix<B>* A = nullptr;
  BlockMatrix<B> own_matrix;                    ///< coarse levels: the Galerkin matrix that A points to
  const GalerkinMatrix<B>* galerkin = nullptr;  ///< coarse levels: what own_matrix is without truncation, if known
  std::vector<double> inverse;                  ///< inverse diagonal blocks
  /// Per vector: the energy that its finest functions have, each by itself, which rounding of A is relative to; empty
  /// on the finest level, where it is the largest entry of the diagonal block.
  std::vector<double> terms;
  const double* b = nullptr;
  double* x = nullptr;
  std::vector<double> own_b, own_x;  ///< coarse levels
  Chunks chunks;                     ///< of A
  Frames<B> frames;
  Constraints<B> constraints;
  std::vector<Segment<B>> segments;
  double relaxation = 1;          ///< of sweeps: LevelView::relaxation
  double inherited_rounding = 0;  ///< rounding_of_work() of the finer levels

  std::vector<Flags> off;            ///< per vector: components prescribed, or without any fine function left
  std::vector<Flags> removed;        ///< per vector: off or truncated; such components do not interpolate
  std::vector<double> lower, upper;  ///< per slot: admissible corrections of x
  std::vector<Flags> critical;       ///< per slot: directions in contact
  std::vector<Flags> phase;          ///< per slot: the critical flags of the last visit
  std::vector<Index> changed;        ///< vectors whose `removed` changed and is not yet in the coarser matrices
  std::vector<Index> renewed;        ///< rows of A recomputed and not yet in the coarser matrices

  /// No direction in contact, no distances; once slots and prescribed components are known.
  void clear_phases() {
    const auto slots = static_cast<std::size_t>(constraints.size());
    removed = off;
    critical.assign(slots, 0);
    phase.assign(slots, 0);
    lower.assign(slots * B, -infinity);
    upper.assign(slots * B, infinity);
  }

  LevelView<B> view() const {
    return {vectors,
            A->row.data(),
            A->column.data(),
            A->value.data(),
            inverse.data(),
            b,
            x,
            constraints.slot.data(),
            constraints.vector.data(),
            constraints.size(),
            constraints.lower.data(),
            constraints.upper.data(),
            relaxation};
  }

  /// One projected Gauss-Seidel sweep over the vectors first <= p < last: one virtual call per segment.
  void sweep(Order order, Index from, Index to) const {
    const LevelView<B> v = view();
    for_each_segment(from, to, order,
                     [&](const Segment<B>& s, Index first, Index last) { s.obstacle->sweep(v, first, last, order); });
  }
  void sweep(Order order) const { sweep(order, 0, vectors); }

  /// Calls visit(segment, first, last) with what each segment has in common with from <= p < to.
  template <class Visit>
  void for_each_segment(Index from, Index to, Order order, const Visit& visit) const {
    const auto count = segments.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Segment<B>& s = segments[order == Order::forward ? i : count - 1 - i];
      const Index first = std::max(from, s.first), last = std::min(to, s.last);
      if (first < last) visit(s, first, last);
    }
  }
};

}  // namespace signorini
