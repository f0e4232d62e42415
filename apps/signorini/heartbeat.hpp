#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace signorini {

/// When something is to be said because nothing has been for a while. Times are seconds of any one clock.
class Silence {
 public:
  Silence(double longest, double now) : longest_(longest), spoke_(now) {}

  void spoke(double now) { spoke_ = now; }
  /// When it becomes too long.
  double ends() const { return spoke_ + longest_; }
  /// Whether it has; then it begins anew.
  bool is_broken(double now);

 private:
  double longest_, spoke_;
};

/// Breaks silence from a thread of its own.
class Heartbeat {
 public:
  /// @param longest seconds of silence
  /// @param say called when they are over, never while note() or speak() are
  Heartbeat(double longest, std::function<void()> say);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Calls `change`, which changes what there is to say, but says nothing.
  void note(const std::function<void()>& change);
  /// Calls `print`, which says something.
  void speak(const std::function<void()>& print);

 private:
  void beat();

  std::function<void()> say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Silence silence_;
  bool over_ = false;
  std::thread thread_;  // begins when all else is there
};

}  // namespace signorini
