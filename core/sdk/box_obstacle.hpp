#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/sdk/box_minimiser.hpp"
#include "core/sdk/obstacle.hpp"
#include "core/sdk/projected_sweep.hpp"

namespace signorini {

/// An obstacle whose admissible set is a box in local coordinates: bounds per direction. What is left to an
/// implementation is descriptor() and assemble(). `Local::correct` is inlined into the sweep that the implementation's
/// own library instantiates.
template <int B, class Local = BoxMinimiser<B>>
class BoxObstacle : public Obstacle<B> {
 public:
  void sweep(const LevelView<B>& level, Index first, Index last, Order order) const noexcept override {
    projected_sweep<B, Local>(level, first, last, order);
  }

  void distance(const LevelView<B>& level, Index first, Index last, double* lower, double* upper,
                Flags* critical) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    if constexpr (scalar)
      if (to - from == last - first) return dense_distance(level, from, first, to - from, lower, upper, critical);
    for (Index slot = from; slot < to; ++slot) {
      const double* x = level.x + Offset{level.constrained[slot]} * B;
      critical[slot] = 0;
      for (int k = 0; k < B; ++k) {
        const Offset at = Offset{slot} * B + k;
        lower[at] = std::min(level.lower[at] - x[k], 0.0);
        upper[at] = std::max(level.upper[at] - x[k], 0.0);
        if (lower[at] == 0 || upper[at] == 0) critical[slot] |= static_cast<Flags>(1u << k);
      }
    }
  }

  double natural_residual(const LevelView<B>& level, Index first, Index last, const double* r) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    if constexpr (scalar)
      if (to - from == last - first) return dense_residual(level, from, first, last, r);
    double largest = 0;
    Index slot = from;
    for (Index p = first; p < last; ++p) {
      double d[B];
      if (slot < level.slots && level.constrained[slot] == p)
        project(level, slot++, r + Offset{p} * B, d);
      else
        block::product<B>(level.inverse + Offset{p} * B * B, r + Offset{p} * B, d);
      largest = block::larger(largest, block::norm<B>(d));
    }
    return largest;
  }

 private:
  static constexpr bool scalar = is_scalar_box<B, Local>;

  // Where every vector has a slot: no branches, so that several are treated at once.
  static void dense_distance(const LevelView<B>& level, Index slot, Index first, Index count, double* lower,
                             double* upper, Flags* critical) {
    const double *x = level.x + first, *low = level.lower + slot, *high = level.upper + slot;
    for (Index i = 0; i < count; ++i) {
      const double below = std::min(low[i] - x[i], 0.0), above = std::max(high[i] - x[i], 0.0);
      lower[slot + i] = below;
      upper[slot + i] = above;
      critical[slot + i] = (below == 0) | (above == 0);
    }
  }

  static double dense_residual(const LevelView<B>& level, Index slot, Index first, Index last, const double* r) {
    const double *x = level.x + first, *inverse = level.inverse + first;
    const double *lower = level.lower + slot, *upper = level.upper + slot;
    r += first;
    std::int64_t largest = 0;  // bits of numbers >= 0 are ordered as the numbers are; NaN is the largest
    for (Index i = 0; i < last - first; ++i) {
      const double size = std::abs(Local::clamp(x[i] + inverse[i] * r[i], lower[i], upper[i]) - x[i]);
      largest = std::max(largest, std::bit_cast<std::int64_t>(size));
    }
    return std::bit_cast<double>(largest);
  }

  // Proj_K(x + A_pp^-1 r) - x in the scalar product of A_pp, in which it vanishes at the solution: the local minimiser.
  static void project(const LevelView<B>& level, Index slot, const double* r, double* d) {
    const Index p = level.constrained[slot];
    if constexpr (scalar) {
      const double x = level.x[p];
      *d = Local::clamp(x + level.inverse[p] * *r, level.lower[slot], level.upper[slot]) - x;
      return;
    }
    double lower[B], upper[B];
    for (int k = 0; k < B; ++k) {
      const double x = level.x[Offset{p} * B + k];
      lower[k] = level.lower[Offset{slot} * B + k] - x;
      upper[k] = level.upper[Offset{slot} * B + k] - x;
    }
    Local::correct(level.value + level.row[p] * B * B, level.inverse + Offset{p} * B * B, r, lower, upper, d);
  }
};

}  // namespace signorini
