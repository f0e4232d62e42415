#pragma once
#include <algorithm>
#include <iterator>
#include <span>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/passes.hpp"

namespace signorini {

// A level consists of parts, each with one subject and one owner, who alone writes it; all others read.

/// The unknowns of a level. Owner: the transfer that makes the level, on the finest one finest_level().
template <int B>
struct LevelSpace {
  Index vectors = 0;
  Frames<B> frames;            ///< the cycle turns their dual where facets are held, see Phases::whole_dual
  Constraints<B> constraints;  ///< coarse levels: bounds of the correction, renewed in every cycle
  std::vector<Flags> off;      ///< per vector: components prescribed, or without any fine function left
};

/// Its matrix. Owner: as above.
template <int B>
struct LevelMatrix {
  const BlockMatrix<B>* A = nullptr;
  BlockMatrix<B> own_matrix;                    ///< coarse levels: the Galerkin matrix that A points to
  const GalerkinMatrix<B>* galerkin = nullptr;  ///< coarse levels: what own_matrix is without truncation, if given
  std::vector<double> inverse;                  ///< inverse diagonal blocks
  /// Per vector: the energy that its finest functions have, each by itself, which rounding of A is relative to; empty
  /// on the finest level, where it is the largest entry of the diagonal block.
  std::vector<double> terms;
  Chunks chunks;  ///< of A
};

/// Right-hand side and solution: on the finest level those of the problem; on coarser ones x is a correction that
/// starts from zero. Owner of the storage: as above; sweeps and coarse solvers improve what x points to.
template <int B>
struct LevelVectors {
  const double* b = nullptr;
  double* x = nullptr;
  std::vector<double> own_b, own_x;  ///< coarse levels
};

/// All that a transfer writes.
template <int B>
struct LevelSystem : LevelSpace<B>, LevelMatrix<B>, LevelVectors<B> {};

/// Where the iterate is in contact. Owner: the cycle, with what the obstacles say.
template <int B>
struct Phases {
  std::vector<double> lower, upper;  ///< per slot: admissible corrections of x
  std::vector<Flags> critical;       ///< per slot: directions in contact
  std::vector<Flags> phase;          ///< per slot: the critical flags of the last visit
  std::vector<Flags> truncated;      ///< per vector: components that do not interpolate though they are not off
  std::vector<Flags> removed;        ///< per vector: off or truncated, which interpolation asks for

  /// Of all frames, where slots have facets: their dual without what the facets that are touched take out. That of the
  /// level's frames is N P, with the projector P of Polyhedron::hold(): so these do not interpolate either.
  std::vector<double> whole_dual;

  void clear(const std::vector<Flags>& off, std::size_t slots) {
    truncated.assign(off.size(), 0);
    removed = off;
    critical.assign(slots, 0);
    phase.assign(slots, 0);
    lower.assign(slots * B, -infinity);
    upper.assign(slots * B, infinity);
  }
};

/// What the functionals are near the iterate; empty without them. Owner: the cycle, with what the obstacles say.
template <int B>
struct SmoothPiece {
  std::vector<double> gradient, hessian;  ///< B and B * B per slot: of phi at the last visit, see QuadraticModel
  std::vector<double> used_hessian;       ///< B * B per slot: what the coarser matrices contain

  void clear(std::size_t slots) {
    gradient.assign(slots * B, 0.0);
    hessian.assign(slots * B * B, 0.0);
    used_hessian.assign(slots * B * B, 0.0);
  }
};

/// What the coarser matrices do not contain yet. Owner: the cycle.
struct Outdated {
  std::vector<Index> changed;  ///< vectors whose truncation changed
  std::vector<Index> renewed;  ///< rows of A recomputed

  void clear() {
    changed.clear();
    renewed.clear();
  }
};

/// One level of the hierarchy, all in local coordinates.
template <int B>
struct Level : LevelSystem<B> {
  std::vector<Segment<B>> segments;
  bool nonlinear = false;         ///< an obstacle of this level adds to the energy
  double relaxation = 1;          ///< of sweeps: LevelView::relaxation
  double inherited_rounding = 0;  ///< rounding_of_work() of the finer levels

  Phases<B> phases;
  SmoothPiece<B> piece;
  Outdated outdated;

  /// Components of vector p that do not interpolate: off or truncated.
  Flags removed(Index p) const { return phases.removed[p]; }

  /// Truncates these components of vector p and no others. Returns whether that is a change.
  bool truncate(Index p, Flags components) {
    phases.truncated[p] = components & static_cast<Flags>(~this->off[p]);
    const Flags now = components | this->off[p];
    if (now == phases.removed[p]) return false;
    phases.removed[p] = now;
    outdated.changed.push_back(p);
    return true;
  }

  /// Says that these rows of the matrix, and with them components that are off, have been recomputed.
  void renew(const std::vector<Index>& rows) {
    for (const Index p : rows) phases.removed[p] = this->off[p] | phases.truncated[p];
    outdated.renewed.insert(outdated.renewed.end(), rows.begin(), rows.end());
  }

  /// No direction in contact, no distances; once slots and prescribed components are known.
  void clear_phases() {
    const auto slots = static_cast<std::size_t>(this->constraints.size());
    phases.clear(this->off, slots);
    if (nonlinear) piece.clear(slots);
  }

  /// Takes the facets that x touches at a slot out of the interpolation, beside the components in `held`, and shares
  /// what the others leave among the components that are left. Returns whether the frame of interpolation has changed;
  /// the components that are left none of are added to `held`.
  bool hold_facets(Index slot, Flags& held) {
    const Constraints<B>& c = this->constraints;
    const Index p = c.vector[slot];
    const double* v = this->x + Offset{p} * B;
    double *lower = phases.lower.data() + Offset{slot} * B, *upper = phases.upper.data() + Offset{slot} * B;
    const Polyhedron<B> polyhedron = c.polyhedron(slot);
    const Offset frame = Offset{this->frames.slot[p]} * B * B;
    double P[B * B], dual[B * B];
    held = polyhedron.hold(v, held, P);
    block::multiply<B>(phases.whole_dual.data() + frame, P, dual);
    for (int k = 0; k < B; ++k) {
      lower[k] = std::min(c.lower[Offset{slot} * B + k] - v[k], 0.0);
      upper[k] = std::max(c.upper[Offset{slot} * B + k] - v[k], 0.0);
    }
    polyhedron.share(v, P, lower, upper);
    double* now = this->frames.dual.data() + frame;
    const bool turned = !std::equal(dual, dual + B * B, now);
    std::copy_n(dual, B * B, now);
    return turned;
  }

  /// r -= gradient of phi at the last visit, at the vectors first <= p < last; r: B each, from `first` on.
  void subtract_gradient(Index first, Index last, double* r) const {
    const Constraints<B>& c = this->constraints;
    const auto [from, to] = slots_between(c, first, last);
    for (Index slot = from; slot < to; ++slot)
      for (int i = 0; i < B; ++i) r[Offset{c.vector[slot] - first} * B + i] -= piece.gradient[Offset{slot} * B + i];
  }

  /// Hessian of phi at vector p, as the coarser matrices contain it; null where there is none.
  const double* curvature(Index p) const {
    const Index slot = this->constraints.slot[p];
    return slot < 0 ? nullptr : piece.used_hessian.data() + Offset{slot} * B * B;
  }

  LevelView<B> view() const {
    const Constraints<B>& c = this->constraints;
    return {this->vectors,
            this->A->row.data(),
            this->A->column.data(),
            this->A->value.data(),
            this->inverse.data(),
            this->b,
            this->x,
            c.slot.data(),
            c.vector.data(),
            c.size(),
            c.lower.data(),
            c.upper.data(),
            relaxation,
            c.data.data(),
            c.width,
            c.last.data(),
            c.tangential.data(),
            c.facet_row.empty() ? nullptr : c.facet_row.data(),
            c.facet.data(),
            c.before.data()};
  }

  /// Phases of the iterate at the vectors first <= p < last: what the bounds admit and hold, and phi's linearisation.
  void locate(Index from, Index to) {
    const LevelView<B> v = view();
    double *lower = phases.lower.data(), *upper = phases.upper.data();
    Flags* critical = phases.critical.data();
    const QuadraticModel<B> model{piece.gradient.data(), piece.hessian.data(), lower, upper, critical};
    for_each_segment(from, to, Order::forward, [&](const Segment<B>& s, Index first, Index last) {
      s.obstacle->distance(v, first, last, lower, upper, critical);
      if (!nonlinear) return;
      if (const Linearisation<B>* phi = s.obstacle->linearisation()) phi->linearise(v, first, last, model);
    });
  }

  /// One projected Gauss-Seidel sweep over the vectors first <= p < last: one virtual call per segment.
  void sweep(Order order, Index from, Index to) const {
    const LevelView<B> v = view();
    for_each_segment(from, to, order,
                     [&](const Segment<B>& s, Index first, Index last) { s.obstacle->sweep(v, first, last, order); });
  }
  void sweep(Order order) const { sweep(order, 0, this->vectors); }

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
