#pragma once
#include <algorithm>
#include <iterator>
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

  /// Of all frames, where slots have facets: their dual without what the facets that are touched take out. That of
  /// `frames` is N P, with the projector P of Polyhedron::hold(): so these do not interpolate either.
  std::vector<double> whole_dual;

  bool nonlinear = false;                 ///< an obstacle of this level adds to the energy; then, else empty:
  std::vector<double> gradient, hessian;  ///< B and B * B per slot: of phi at the last visit, see Linearisation
  std::vector<double> used_hessian;       ///< B * B per slot: what the coarser matrices contain

  /// No direction in contact, no distances; once slots and prescribed components are known.
  void clear_phases() {
    const auto slots = static_cast<std::size_t>(constraints.size());
    removed = off;
    critical.assign(slots, 0);
    phase.assign(slots, 0);
    lower.assign(slots * B, -infinity);
    upper.assign(slots * B, infinity);
    if (!nonlinear) return;
    gradient.assign(slots * B, 0.0);
    hessian.assign(slots * B * B, 0.0);
    used_hessian.assign(slots * B * B, 0.0);
  }

  /// Takes the facets that x touches at a slot out of the interpolation, beside the components in `held`, and shares
  /// what the others leave among the components that are left. Returns whether the frame of interpolation has changed;
  /// the components that are left none of are added to `held`.
  bool hold_facets(Index slot, Flags& held) {
    const Index p = constraints.vector[slot];
    const Polyhedron<B> polyhedron = constraints.polyhedron(slot);
    const Offset frame = Offset{frames.slot[p]} * B * B;
    double P[B * B], dual[B * B];
    held = polyhedron.hold(x + Offset{p} * B, held, P);
    block::multiply<B>(whole_dual.data() + frame, P, dual);
    for (int k = 0; k < B; ++k) {
      lower[Offset{slot} * B + k] = std::min(constraints.lower[Offset{slot} * B + k] - x[Offset{p} * B + k], 0.0);
      upper[Offset{slot} * B + k] = std::max(constraints.upper[Offset{slot} * B + k] - x[Offset{p} * B + k], 0.0);
    }
    polyhedron.share(x + Offset{p} * B, P, lower.data() + Offset{slot} * B, upper.data() + Offset{slot} * B);
    double* now = frames.dual.data() + frame;
    const bool turned = !std::equal(dual, dual + B * B, now);
    std::copy_n(dual, B * B, now);
    return turned;
  }

  /// r -= gradient of phi at the last visit, at the vectors first <= p < last; r: B each, from `first` on.
  void subtract_gradient(Index first, Index last, double* r) const {
    const auto [from, to] = slots_between(constraints, first, last);
    for (Index slot = from; slot < to; ++slot)
      for (int i = 0; i < B; ++i) r[Offset{constraints.vector[slot] - first} * B + i] -= gradient[Offset{slot} * B + i];
  }

  /// Hessian of phi at vector p, as the coarser matrices contain it; null where there is none.
  const double* curvature(Index p) const {
    const Index slot = constraints.slot[p];
    return slot < 0 ? nullptr : used_hessian.data() + Offset{slot} * B * B;
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
            relaxation,
            constraints.data.data(),
            constraints.width,
            constraints.last.data(),
            constraints.tangential.data(),
            constraints.facet_row.empty() ? nullptr : constraints.facet_row.data(),
            constraints.facet.data()};
  }

  /// Phases of the iterate at the vectors first <= p < last: what the bounds admit and hold, and phi's linearisation.
  void locate(Index from, Index to) {
    const LevelView<B> v = view();
    const Linearisation<B> linear{gradient.data(), hessian.data(), lower.data(), upper.data(), critical.data()};
    for_each_segment(from, to, Order::forward, [&](const Segment<B>& s, Index first, Index last) {
      s.obstacle->distance(v, first, last, lower.data(), upper.data(), critical.data());
      if (!nonlinear) return;
      if (const Nonlinearity<B>* phi = s.obstacle->nonlinearity()) phi->linearise(v, first, last, linear);
    });
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
    const auto begin =
        std::partition_point(segments.begin(), segments.end(), [from](const Segment<B>& s) { return s.last <= from; });
    const auto end = std::partition_point(begin, segments.end(), [to](const Segment<B>& s) { return s.first < to; });
    const auto each = [&](const Segment<B>& s) { visit(s, std::max(from, s.first), std::min(to, s.last)); };
    if (order == Order::forward)
      std::for_each(begin, end, each);
    else
      std::for_each(std::make_reverse_iterator(end), std::make_reverse_iterator(begin), each);
  }
};

}  // namespace signorini
