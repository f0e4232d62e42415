#include "apps/signorini/heartbeat.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/base/clock.hpp"

namespace signorini {

void Silence::phase(const std::string& what, double now) {
  what_ = what;
  since_ = now;
}

std::optional<std::string> Silence::line(double now) {
  if (now < ends()) return {};
  spoke_ = now;
  return fmt::format("{}: {:.0f} s so far", what_, now - since_);
}

Heartbeat::Heartbeat(double longest, std::function<void(const std::string&)> say)
    : say_(std::move(say)), silence_(longest, seconds()), thread_([this] { beat(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Heartbeat::begin(const std::string& what, const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  silence_.phase(what, seconds());
  if (!print) return;
  print();
  silence_.spoke(seconds());
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
    if (const auto line = silence_.line(seconds())) say_(*line);
  }
}

}  // namespace signorini
