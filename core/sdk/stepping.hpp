#pragma once
#include "core/sdk/status.hpp"

namespace signorini {

/// A load step, or the part of one that is solved on its own: t goes from `from`, where the last one ended, to `to`.
/// Members are only ever added, at the end.
struct LoadStep {
  int number = 1;  ///< of the scene's step, from 1
  double from = 0, to = 1;
  int halvings = 0;  ///< how often the step was cut in two to get this part
};

/// Of an obstacle that integrates in time, counts steps or decays with them: what depends on how long a step is. It is
/// an extension: an obstacle that has it derives from it beside Obstacle<B>, and is asked for it by dynamic_cast.
class Stepping {
 public:
  virtual ~Stepping();

  /// The step that the obstacle is made for, before anything else is asked of it. Each step has an obstacle of its own,
  /// and so has each part of one that is cut. What is only looked at, by `signorini check` and the like, is a step from
  /// 0 to its t.
  virtual void begin(const LoadStep& step, Status& status) noexcept = 0;

  /// Whether a step that is not solved may be tried again in two parts, with what begin() is told then. False: the
  /// steps end there.
  virtual bool may_be_cut() const noexcept { return true; }
};

}  // namespace signorini
