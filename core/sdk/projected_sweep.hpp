#pragma once
#include <algorithm>

#include "core/sdk/block.hpp"
#include "core/sdk/level_view.hpp"

namespace signorini {

/// r = b_p - (A x)_p
template <int B>
inline void row_residual(const LevelView<B>& level, Index p, double* r) {
  const Offset k = level.row[p];
  double Ax[B];
  block::row_product<B>(level.value + k * B * B, level.column + k, level.row[p + 1] - k, level.x, Ax);
  for (int i = 0; i < B; ++i) r[i] = level.b[Offset{p} * B + i] - Ax[i];
}

/// relaxation A_pp^-1. It is the inverse that is scaled, since the next vector waits for what follows the residual.
template <int B>
inline void relaxed_inverse(const LevelView<B>& level, Index p, double* out) {
  for (int i = 0; i < B * B; ++i) out[i] = level.relaxation * level.inverse[Offset{p} * B * B + i];
}

/// Over-relaxed Gauss-Seidel at a vector without obstacle.
template <int B>
inline void relax(const LevelView<B>& level, Index p) {
  double inverse[B * B], r[B];
  relaxed_inverse<B>(level, p, inverse);
  row_residual<B>(level, p, r);
  block::add_product<B>(inverse, r, level.x + Offset{p} * B);
}

/// Whether the local problem is scalar and solved by cutting off what is beyond the bounds.
template <int B, class Local>
inline constexpr bool is_scalar_box = B == 1 && requires {
  Local::clamp(0.0, 0.0, 0.0);
};

/// Over-relaxed Gauss-Seidel at a scalar up to its bounds.
template <class Local>
inline void relax_clamped(const LevelView<1>& level, Index p, double lower, double upper) {
  double inverse, r;
  relaxed_inverse<1>(level, p, &inverse);
  row_residual<1>(level, p, &r);
  level.x[p] = Local::clamp(level.x[p] + inverse * r, lower, upper);
}

/// Projected Gauss-Seidel at the vector of a slot, over-relaxed where that meets no bound, and up to it for scalars.
/// The distance to the bounds is taken from the iterate every time: updating it along the sweep is unstable (Krause,
/// remark 4.3).
template <int B, class Local>
inline void relax_projected(const LevelView<B>& level, Index slot) {
  const Index p = level.constrained[slot];
  double* x = level.x + Offset{p} * B;
  if constexpr (is_scalar_box<B, Local>) return relax_clamped<Local>(level, p, level.lower[slot], level.upper[slot]);
  const double* bound[2] = {level.lower + Offset{slot} * B, level.upper + Offset{slot} * B};
  double inverse[B * B], r[B], lower[B], upper[B], d[B];
  relaxed_inverse<B>(level, p, inverse);
  row_residual<B>(level, p, r);
  for (int k = 0; k < B; ++k) {
    lower[k] = bound[0][k] - x[k];
    upper[k] = bound[1][k] - x[k];
  }
  block::product<B>(inverse, r, d);
  bool inside = true;
  for (int k = 0; k < B; ++k) inside = inside && d[k] >= lower[k] && d[k] <= upper[k];
  if (!inside)
    Local::correct(level.value + level.row[p] * B * B, level.inverse + Offset{p} * B * B, r, lower, upper, d);
  // Set, not added, where a bound is met: contact then is an exact comparison.
  for (int k = 0; k < B; ++k) x[k] = d[k] <= lower[k] ? bound[0][k] : d[k] >= upper[k] ? bound[1][k] : x[k] + d[k];
}

/// Slots of the vectors first <= p < last: the first one, and one behind the last.
template <int B>
inline std::pair<Index, Index> slots_between(const LevelView<B>& level, Index first, Index last) {
  if (level.slots == level.vectors) return {first, last};
  const Index* end = level.constrained + level.slots;
  const Index* from = std::lower_bound(level.constrained, end, first);
  return {static_cast<Index>(from - level.constrained),
          static_cast<Index>(std::lower_bound(from, end, last) - level.constrained)};
}

/// The sweep of a scalar problem all of whose vectors have slots, that of `first` being `slot`: no look-ups.
template <class Local>
void dense_projected_sweep(LevelView<1> level, Index slot, Index first, Index last, Order order) {
  const double *lower = level.lower + slot - first, *upper = level.upper + slot - first;
  if (order == Order::forward)
    for (Index p = first; p < last; ++p) relax_clamped<Local>(level, p, lower[p], upper[p]);
  else
    for (Index p = last - 1; p >= first; --p) relax_clamped<Local>(level, p, lower[p], upper[p]);
}

/// One block Gauss-Seidel sweep over first <= p < last: relax_slot(slot) treats the vectors that have a slot, runs of
/// vectors without obstacle pass through the plain linear loop.
template <int B, class RelaxSlot>
inline void sweep_slots(const LevelView<B>& level, Index from, Index to, Index first, Index last, Order order,
                        const RelaxSlot& relax_slot) {
  if (order == Order::forward) {
    Index p = first;
    for (Index slot = from; slot < to; ++slot) {
      for (; p < level.constrained[slot]; ++p) relax<B>(level, p);
      relax_slot(slot);
      ++p;
    }
    for (; p < last; ++p) relax<B>(level, p);
  } else {
    Index p = last - 1;
    for (Index slot = to - 1; slot >= from; --slot) {
      for (; p > level.constrained[slot]; --p) relax<B>(level, p);
      relax_slot(slot);
      --p;
    }
    for (; p >= first; --p) relax<B>(level, p);
  }
}

/// One projected block Gauss-Seidel sweep over first <= p < last; Local::correct is the exact local minimiser. The view
/// is copied: the compiler then knows that a store to the iterate changes nothing of it.
template <int B, class Local>
void projected_sweep(LevelView<B> level, Index first, Index last, Order order) {
  const auto [from, to] = slots_between(level, first, last);
  if constexpr (is_scalar_box<B, Local>)
    if (to - from == last - first) return dense_projected_sweep<Local>(level, from, first, last, order);
  sweep_slots<B>(level, from, to, first, last, order, [&level](Index slot) { relax_projected<B, Local>(level, slot); });
}

}  // namespace signorini
