#include "apps/signorini/heartbeat.hpp"

#include <chrono>
#include <utility>

#include "core/base/clock.hpp"

namespace signorini {

bool Silence::is_broken(double now) {
  if (now < ends()) return false;
  spoke_ = now;
  return true;
}

Heartbeat::Heartbeat(double longest, std::function<void()> say)
    : say_(std::move(say)), silence_(longest, seconds()), thread_([this] { beat(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Heartbeat::note(const std::function<void()>& change) {
  const std::lock_guard lock(mutex_);
  change();
}

void Heartbeat::speak(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  print();
  silence_.spoke(seconds());
}

void Heartbeat::beat() {
  std::unique_lock lock(mutex_);
  while (!over_) {
    changed_.wait_for(lock, std::chrono::duration<double>(silence_.ends() - seconds()));
    if (over_) return;
    if (silence_.is_broken(seconds())) say_();
  }
}

}  // namespace signorini
