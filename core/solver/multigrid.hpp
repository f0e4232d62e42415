#pragma once
#include <span>

#include "core/solver/components.hpp"

namespace signorini {

/// What one cycle did to the phases on the finest level.
struct CycleReport {
  Index contact = 0;    ///< vectors with a direction in contact
  Index changed = 0;    ///< vectors whose phase changed since the last cycle
  Index renewed = 0;    ///< coarse matrix rows recomputed, on all levels
  double rounding = 0;  ///< rounding_of_work() on the finest level
  bool bounded = true;  ///< false: the energy has no minimum
};

/// Truncated monotone multigrid (Krause, Alg. 1): nonlinear smoothing on the true constraints, then corrections from
/// coarser levels within monotonically restricted bounds. Knows no kind of obstacle, mesh or dimension.
template <int B>
class MonotoneMultigrid {
 public:
  struct Settings {
    int pre = 1, post = 1;
    int gamma = 1;  ///< 1: V, 2: W
    bool truncate = true;
    Rotate rotate = Rotate::all;
  };

  /// Keeps references to the problem and the prolongations (coarsest first).
  MonotoneMultigrid(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                    Components<B> components, Settings settings);

  /// One cycle on x (B per vector, admissible). The energy never grows. `before` and `after` see disjoint ranges of
  /// vectors that cover all: before the cycle touches them, and when they and all that they are coupled to are final.
  CycleReport cycle(double* x, const Passes::Run& before = {}, const Passes::Run& after = {});

  const Level<B>& finest() const { return levels_.back(); }
  const std::vector<Level<B>>& levels() const { return levels_; }

 private:
  void descend(std::size_t k, const Passes::Run& before, const Passes::Run& after);
  void correct(std::size_t k);
  void update_phases(Level<B>& level, Index first, Index last);
  void restrict_residual(std::size_t k, Index first, Index last);

  std::vector<Level<B>> levels_;  // coarsest first
  std::vector<std::unique_ptr<Transfer<B>>> transfers_;
  Components<B> components_;
  Settings settings_;
  CycleReport report_;
  std::vector<double> r_;  // residual of one chunk
};

/// Levels for block size B on the finest matrix alone.
template <int B>
Level<B> finest_level(const DiscreteProblem<B>& problem);

}  // namespace signorini
