#pragma once
#include <atomic>
#include <string>

#include "core/solver/summary.hpp"

namespace signorini {

/// Whoever waits for long work is told by it how it goes on, and may end it. This one listens to nothing and waits.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A phase begins.
  virtual void phase(const std::string& what) const;
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
