#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace signorini {

/// What to say when nothing has been said for a while: the phase that goes on, and since when. Times are seconds of any
/// one clock.
class Silence {
 public:
  Silence(double longest, double now) : longest_(longest), since_(now), spoke_(now) {}

  /// A phase begins.
  void phase(const std::string& what, double now);
  /// Something was said.
  void spoke(double now) { spoke_ = now; }
  /// When silence becomes too long.
  double ends() const { return spoke_ + longest_; }
  /// A line once it has, and nothing before.
  std::optional<std::string> line(double now);

 private:
  double longest_, since_, spoke_;
  std::string what_ = "at work";
};

/// Breaks silence from a thread of its own.
class Heartbeat {
 public:
  /// @param longest seconds of silence
  /// @param say called with a line, never while begin() or speak() are
  Heartbeat(double longest, std::function<void(const std::string&)> say);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// A phase begins; `print` says so, if there is one.
  void begin(const std::string& what, const std::function<void()>& print = {});
  void speak(const std::function<void()>& print);

 private:
  void beat();

  std::function<void(const std::string&)> say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Silence silence_;
  bool over_ = false;
  std::thread thread_;  // begins when all else is there
};

}  // namespace signorini
