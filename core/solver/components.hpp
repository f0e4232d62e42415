#pragma once
#include <functional>
#include <memory>

#include "core/solver/level.hpp"
#include "core/solver/prolongation.hpp"

/// What the kernel composes a cycle from. Implementations lie in smoothers/, transfer/ and amg/ and are chosen by name.
namespace signorini {

enum class Side { descend, ascend };

/// A smoother at work on one level.
template <int B>
class LevelSmoother {
 public:
  virtual ~LevelSmoother() = default;
  /// Adds the passes of `steps` smoothing steps on level.x, on the way down or up. The energy never grows.
  virtual void add_passes(int steps, Side side, Passes& passes) = 0;
};

template <int B>
class Smoother {
 public:
  virtual ~Smoother() = default;
  /// For a level whose pattern, bounds and prescribed components are known; the reference is kept.
  virtual std::unique_ptr<LevelSmoother<B>> on(const Level<B>& level) const = 0;
};

/// Which coarse vectors take over the frame of their twin on the next finer level.
enum class Rotate { all, not_coarsest, meshes, none };

/// The connection of a level with the next coarser one. Interpolation of vector q to p is w_pq R_p C_q with the scalar
/// weight w, C_q from local to global coordinates and R_p back, R_p without the components removed at p.
template <int B>
class Transfer {
 public:
  virtual ~Transfer() = default;
  /// Once: sizes, frames, prescribed components, slots and matrix pattern of the coarse level, and its matrix where
  /// coarse.galerkin knows that.
  virtual void prepare(const Level<B>& fine, const Prolongation& prolongation, bool rotate, LevelSystem<B>& coarse) = 0;
  /// prepare() with the whole matrix, from what is truncated on the fine level now, in one pass over the fine matrix.
  /// Does not look at coarse.galerkin.
  virtual void prepare_assembled(const Level<B>& fine, const Prolongation& prolongation, bool rotate,
                                 LevelSystem<B>& coarse) = 0;
  /// Coarse rows (Galerkin) near what is outdated on the fine level, all of them the first time if none is known.
  /// Returns their numbers, until the next call.
  virtual const std::vector<Index>& assemble(const Level<B>& fine, LevelSystem<B>& coarse) = 0;
  /// coarse.b = coarse.x = 0.
  virtual void begin_restriction(LevelSystem<B>& coarse) const = 0;
  /// Adds to coarse.b what the residuals of the fine vectors first <= p < last contribute; r: B each, from `first` on.
  virtual void restrict_residual(const Level<B>& fine, Index first, Index last, const double* r,
                                 LevelSystem<B>& coarse) const = 0;
  /// coarse.b in the coordinates of the coarse level, once its matrix is assembled.
  virtual void end_restriction(LevelSystem<B>& coarse) const = 0;
  /// Monotone restriction (RestrictObstaclesByMatrix and merge, Krause 4.4): bounds of coarse.x such that every
  /// admissible coarse correction is admissible on the fine level. Truncated directions do not count.
  virtual void restrict_bounds(const Level<B>& fine, LevelSystem<B>& coarse) const = 0;
  /// coarse.x in the form that prolongate() reads; it is of no other use afterwards.
  virtual void begin_prolongation(const LevelSystem<B>& coarse) const = 0;
  /// fine.x += interpolation of coarse.x at the vectors first <= p < last; what rounding carries over a bound is put
  /// back onto it.
  virtual void prolongate(const LevelSystem<B>& coarse, const Level<B>& fine, Index first, Index last) const = 0;
};

/// Brings the coarse matrix up to date. Returns the number of rows recomputed.
template <int B>
Index reassemble(Transfer<B>& transfer, Level<B>& fine, Level<B>& coarse) {
  const std::vector<Index>& rows = transfer.assemble(fine, coarse);
  fine.outdated.clear();
  coarse.renew(rows);
  return static_cast<Index>(rows.size());
}

template <int B>
class CoarseSolver {
 public:
  virtual ~CoarseSolver() = default;
  /// Improves level.x within its bounds as far as is worth it on the coarsest level, whose matrix may have changed
  /// since the last call. Returns false where the energy is unbounded below.
  virtual bool solve(const Level<B>& level) = 0;
};

/// The choice for one solve.
template <int B>
struct Components {
  std::shared_ptr<const Smoother<B>> smoother;
  std::function<std::unique_ptr<Transfer<B>>()> transfer;
  std::shared_ptr<CoarseSolver<B>> coarse;
};

}  // namespace signorini
