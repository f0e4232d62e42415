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

  std::unique_ptr<LevelSmoother<B>> on(const Level<B>& level) const override {
    return std::make_unique<Sweeps>(level, order_);
  }

 private:
  class Sweeps final : public LevelSmoother<B> {
   public:
    Sweeps(const Level<B>& level, SweepOrder order) : level_(level), order_(order) {}

    void add_passes(int steps, Side side, Passes& passes) override {
      const bool forward = order_ == SweepOrder::adjoint ? side == Side::descend : order_ != SweepOrder::backward;
      for (int step = 0; step < steps; ++step) {
        add_sweep(forward ? Order::forward : Order::backward, passes);
        if (order_ == SweepOrder::symmetric) add_sweep(Order::backward, passes);
      }
    }

   private:
    void add_sweep(Order order, Passes& passes) const {
      passes.add(order, [this, order](Index first, Index last) { level_.sweep(order, first, last); });
    }

    const Level<B>& level_;
    SweepOrder order_;
  };

  SweepOrder order_;
};

}  // namespace signorini
