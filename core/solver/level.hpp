#pragma once
#include <span>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// One level of the hierarchy: matrix, vectors, bounds and phases, all in local coordinates. On the finest level A, b
/// and x belong to the problem; on coarser ones x is a correction that starts from zero.
template <int B>
struct Level {
  Index vectors = 0;
  const BlockMatrix<B>* A = nullptr;
  BlockMatrix<B> own_matrix;    ///< coarse levels: the Galerkin matrix that A points to
  std::vector<double> inverse;  ///< inverse diagonal blocks
  const double* b = nullptr;
  double* x = nullptr;
  std::vector<double> own_b, own_x;  ///< coarse levels
  std::vector<double> r;             ///< residual
  Frames<B> frames;
  Constraints<B> constraints;
  std::vector<Segment<B>> segments;
  double inherited_rounding = 0;  ///< rounding_of_work() of the next finer level

  std::vector<Flags> off;            ///< per vector: components prescribed, or without any fine function left
  std::vector<Flags> removed;        ///< per vector: off or truncated; such components do not interpolate
  std::vector<double> lower, upper;  ///< per slot: admissible corrections of x
  std::vector<Flags> critical;       ///< per slot: directions in contact
  std::vector<Flags> phase;          ///< per slot: the critical flags of the last visit
  std::vector<Index> changed;        ///< vectors whose `removed` changed and is not yet in the coarser matrices
  std::vector<Index> renewed;        ///< rows of A recomputed and not yet in the coarser matrices

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
            constraints.upper.data()};
  }

  /// One projected Gauss-Seidel sweep: one virtual call per segment.
  void sweep(Order order) const {
    const LevelView<B> v = view();
    const auto count = segments.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Segment<B>& s = segments[order == Order::forward ? i : count - 1 - i];
      s.obstacle->sweep(v, s.first, s.last, order);
    }
  }
};

}  // namespace signorini
