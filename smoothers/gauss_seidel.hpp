#pragma once
#include "core/solver/components.hpp"

namespace signorini {

enum class SweepOrder { forward, backward, symmetric, adjoint };

/// Projected block Gauss-Seidel. `forward` and `backward` sweep one way; `symmetric` does both in every step; `adjoint`
/// sweeps forward on the way down and backward on the way up, which makes the whole linear cycle symmetric at half
/// the cost.
template <int B>
class GaussSeidel final : public Smoother<B> {
 public:
  explicit GaussSeidel(SweepOrder order) : order_(order) {}

  void add_passes(const Level<B>& level, int steps, Side side, Passes& passes) const override {
    const bool forward = order_ == SweepOrder::adjoint ? side == Side::descend : order_ != SweepOrder::backward;
    for (int step = 0; step < steps; ++step) {
      add_sweep(level, forward ? Order::forward : Order::backward, passes);
      if (order_ == SweepOrder::symmetric) add_sweep(level, Order::backward, passes);
    }
  }

 private:
  static void add_sweep(const Level<B>& level, Order order, Passes& passes) {
    passes.add(order, [&level, order](Index first, Index last) { level.sweep(order, first, last); });
  }

  SweepOrder order_;
};

}  // namespace signorini
