#pragma once
#include <algorithm>
#include <utility>

#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/constrained_minimiser.hpp"

namespace signorini {

/// What a local functional knows of its vector: B components in local coordinates.
template <int B>
struct Slot {
  const double *lower, *upper;     ///< bounds; equal where a component is prescribed
  const double* data;              ///< as LocalConstraint::data
  const double* last;              ///< its values after the last load step, zero in the first
  Flags tangential;                ///< components orthogonal to the obstacle's direction
  const double* before = nullptr;  ///< data at the end of the last load step, zero in the first
};

/// An obstacle with bounds in local coordinates and a functional phi. What is left to an implementation is
/// descriptor(), assemble() and three classes that know a single vector:
/// - `Phi`, the functional: `double change(const Slot<B>&, const double* from, const double* to)` and `double
/// slope(const
///   Slot<B>&, const double* at, const double* step)`, as in Functional;
/// - `Solver`, the local solver: `void minimise(const Slot<B>&, const double* M, const double* r, const double* x,
///   double* y)` with the minimiser y of 1/2 (y-x)'M(y-x) - r'(y-x) + phi(y) within the bounds; kinks and bounds are
///   met exactly, not up to rounding;
/// - `Model`, its linearisation: `void linearise(const Slot<B>&, const double* x, const QuadraticModel<B>& out)`, `out`
///   being that of this vector alone, gradient and hessian zero on entry.
/// One class may be all of them. Functions are static, or members of objects that the constructor takes, and inlined
/// into loops that the implementation's own library instantiates. Implementations that have a Renewal, a Scaling or a
/// Friction derive from these, too.
template <int B, class Phi, class Solver = Phi, class Model = Phi>
class FunctionalObstacle : public BoxObstacle<B>, public Functional<B>, public Linearisation<B> {
 public:
  FunctionalObstacle() = default;
  FunctionalObstacle(Phi phi, Solver solver, Model model)
      : phi_(std::move(phi)), solver_(std::move(solver)), model_(std::move(model)) {}

  const Functional<B>* functional() const noexcept final { return this; }
  const Linearisation<B>* linearisation() const noexcept final { return this; }

  // Where bounds are all there is over-relaxation pays; beyond a kink it would not lower the energy.
  void sweep(const LevelView<B>& view, Index first, Index last, Order order) const noexcept override {
    const LevelView<B> level = view;  // stores to the iterate change nothing of it
    const auto [from, to] = slots_between(level, first, last);
    sweep_slots<B>(level, from, to, first, last, order, [&level, this](Index slot) {
      const Index p = level.constrained[slot];
      double r[B], y[B];
      row_residual<B>(level, p, r);
      if (minimise(level, slot, r, y)) std::copy_n(y, B, level.x + Offset{p} * B);
    });
  }

  void distance(const LevelView<B>& level, Index first, Index last, double* lower, double* upper,
                Flags* critical) const noexcept override {
    BoxObstacle<B>::distance(level, first, last, lower, upper, critical);
    const auto [from, to] = slots_between(level, first, last);
    share_facets(level, from, to, lower, upper, critical);
  }

  double natural_residual(const LevelView<B>& level, Index first, Index last, const double* r) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    double largest = 0;
    Index slot = from;
    for (Index p = first; p < last; ++p) {
      double d[B];
      if (slot < to && level.constrained[slot] == p) {
        if (minimise(level, slot++, r + Offset{p} * B, d))
          for (int k = 0; k < B; ++k) d[k] -= level.x[Offset{p} * B + k];
        else  // nothing is solved there
          block::product<B>(level.inverse + Offset{p} * B * B, r + Offset{p} * B, d);
      } else {
        block::product<B>(level.inverse + Offset{p} * B * B, r + Offset{p} * B, d);
      }
      largest = block::larger(largest, block::norm<B>(d));
    }
    return largest;
  }

  double change(const LevelView<B>& level, Index first, Index last, const double* from,
                const double* to) const noexcept override {
    return sum(level, first, last,
               [&](Index slot, Offset at) { return phi_.change(slot_of(level, slot), from + at, to + at); });
  }

  double slope(const LevelView<B>& level, Index first, Index last, const double* at,
               const double* step) const noexcept override {
    return sum(level, first, last,
               [&](Index slot, Offset i) { return phi_.slope(slot_of(level, slot), at + i, step + i); });
  }

  void linearise(const LevelView<B>& level, Index first, Index last,
                 const QuadraticModel<B>& out) const noexcept override {
    sum(level, first, last, [&](Index slot, Offset at) {
      const QuadraticModel<B> own{out.gradient + Offset{slot} * B, out.hessian + Offset{slot} * B * B,
                                  out.lower + Offset{slot} * B, out.upper + Offset{slot} * B, out.critical + slot};
      std::fill_n(own.gradient, B, 0.0);
      std::fill_n(own.hessian, B * B, 0.0);
      model_.linearise(slot_of(level, slot), level.x + at, own);
      return 0.0;
    });
  }

 protected:
  static Slot<B> slot_of(const LevelView<B>& level, Index slot) {
    return {level.lower + Offset{slot} * B, level.upper + Offset{slot} * B, level.data + Offset{slot} * level.width,
            level.last + Offset{slot} * B,  level.tangential[slot],         level.before + Offset{slot} * level.width};
  }

 private:
  /// False where faces leave nothing admissible.
  bool minimise(const LevelView<B>& level, Index slot, const double* r, double* y) const {
    const Index p = level.constrained[slot];
    const double *M = level.value + level.row[p] * B * B, *x = level.x + Offset{p} * B;
    if (B == 1 || !has_facets(level, slot)) {
      solver_.minimise(slot_of(level, slot), M, r, x, y);
      return true;
    }
    const Slot<B> own = slot_of(level, slot);
    const auto with_force = [&](const double* force, double* out) {
      double sum[B];
      for (int i = 0; i < B; ++i) sum[i] = r[i] + force[i];
      solver_.minimise(own, M, sum, x, out);
    };
    double stiffness[B];
    for (int i = 0; i < B; ++i) stiffness[i] = M[i * (B + 1)];
    const Polyhedron<B> polyhedron(level, slot);
    return ConstrainedMinimiser<B, decltype(with_force)>(polyhedron, stiffness, with_force).run(y);
  }

  /// Of term(slot, place of its vector) over the slots.
  template <class Term>
  static double sum(const LevelView<B>& level, Index first, Index last, const Term& term) {
    const auto [from, to] = slots_between(level, first, last);
    double out = 0;
    for (Index slot = from; slot < to; ++slot) out += term(slot, Offset{level.constrained[slot]} * B);
    return out;
  }

  [[no_unique_address]] Phi phi_;
  [[no_unique_address]] Solver solver_;
  [[no_unique_address]] Model model_;
};

}  // namespace signorini
