#pragma once
#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/polyhedron.hpp"

namespace signorini {

/// The kernel's own obstacle: bounds alone, and facets where there are any. It rules coarse levels, whose bounds come
/// from the monotone restriction, and on the finest one the vectors where several obstacles make a polyhedron.
template <int B>
class PolyhedralBox final : public BoxObstacle<B> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"box", B, 2}}}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status& status) const noexcept override {
    status.fail(1, "these bounds come from other obstacles");
  }

  void sweep(const LevelView<B>& level, Index first, Index last, Order order) const noexcept override {
    if (B == 1 || !level.facet_row)
      BoxObstacle<B>::sweep(level, first, last, order);
    else
      sweep_with_facets(level, first, last, order);
  }

  void distance(const LevelView<B>& level, Index first, Index last, double* lower, double* upper,
                Flags* critical) const noexcept override {
    BoxObstacle<B>::distance(level, first, last, lower, upper, critical);
    const auto [from, to] = slots_between(level, first, last);
    share_facets(level, from, to, lower, upper, critical);
  }

  double natural_residual(const LevelView<B>& level, Index first, Index last, const double* r) const noexcept override {
    if (!level.facet_row) return BoxObstacle<B>::natural_residual(level, first, last, r);
    double largest = 0;
    const auto [from, to] = slots_between(level, first, last);
    for (Index slot = from; slot < to; ++slot) {
      const Index p = level.constrained[slot];
      if (!has_facets(level, slot)) continue;
      largest = block::larger(largest, residual_in_polyhedron(level, slot, r + Offset{p} * B));
      largest = block::larger(largest, BoxObstacle<B>::natural_residual(level, first, p, r));
      first = p + 1;
    }
    return block::larger(largest, BoxObstacle<B>::natural_residual(level, first, last, r));
  }

 private:
  /// The view is copied: stores to the iterate change nothing of it. Flattened: rows are too short for a call each.
  [[gnu::flatten]] static void sweep_with_facets(LevelView<B> level, Index first, Index last, Order order) {
    const auto [from, to] = slots_between(level, first, last);
    sweep_slots<B>(level, from, to, first, last, order, [&level](Index slot) {
      if (has_facets(level, slot))
        relax_in_polyhedron(level, slot);
      else
        relax_projected<B, BoxMinimiser<B>>(level, slot);
    });
  }

  /// The minimiser without bounds, relaxed, and that within them where it is not admissible.
  static void relax_in_polyhedron(const LevelView<B>& level, Index slot) {
    const Index p = level.constrained[slot];
    const Polyhedron<B> polyhedron(level, slot);
    double* x = level.x + Offset{p} * B;
    double inverse[B * B], r[B], y[B], target[B];
    relaxed_inverse<B>(level, p, inverse);
    row_residual<B>(level, p, r);
    target_of(x, inverse, r, target);
    if (polyhedron.contains(target)) {
      std::copy_n(target, B, x);
      return;
    }
    target_of(x, level.inverse + Offset{p} * B * B, r, target);
    if (polyhedron.nearest(level.value + level.row[p] * B * B, target, y)) std::copy_n(y, B, x);
  }

  static double residual_in_polyhedron(const LevelView<B>& level, Index slot, const double* r) {
    const Index p = level.constrained[slot];
    const double* x = level.x + Offset{p} * B;
    double target[B], y[B];
    target_of(x, level.inverse + Offset{p} * B * B, r, target);
    if (!Polyhedron<B>(level, slot).nearest(level.value + level.row[p] * B * B, target, y))
      std::copy_n(target, B, y);  // nothing is solved there
    for (int k = 0; k < B; ++k) y[k] -= x[k];
    return block::norm<B>(y);
  }

  static void target_of(const double* x, const double* inverse, const double* r, double* target) {
    std::copy_n(x, B, target);
    block::add_product<B>(inverse, r, target);
  }
};

}  // namespace signorini
