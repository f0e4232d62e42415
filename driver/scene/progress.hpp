#pragma once
#include <atomic>
#include <string>

#include "core/sdk/stepping.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// What a solve is for.
struct Goal {
  bool result = false;  ///< on the finest mesh, and not for a start
  double tolerance = 0;
  int copies = 1;  ///< so many times the energy of its cycles is that of the body, see BodyReport
};

/// Whoever waits for long work is told by it how it goes on, and may end it. This one listens to nothing and waits.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A load step begins, or a part of one; the scene has so many steps.
  virtual void step(const LoadStep& step, int of) const;
  /// A phase begins.
  virtual void phase(const std::string& what) const;
  /// A solve begins. The cycles that follow are those of it, until the next phase.
  virtual void solving(const Goal& goal) const;
  /// A cycle on the finest level of a solve is over.
  virtual void cycle(const IterationRecord& record) const;
  /// Whether the work is to end: asked between phases, cycles and points of a mesh.
  virtual bool interrupted() const;
  /// Whether interrupted() has said so at any time since listen(): what it says once holds on every level.
  bool is_ended() const;
  /// Error(Exit::interrupted) where it is.
  void stop_if_interrupted() const;
  /// New work begins, and may be ended anew.
  void listen() const { ended_ = false; }

 private:
  mutable std::atomic<bool> ended_ = false;
};

}  // namespace signorini
