#include "core/base/crew.hpp"

#include <utility>

namespace signorini {

Crew::~Crew() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  begin_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Crew::run(const std::function<void()>& task) {
  threads_.reserve(static_cast<std::size_t>(size_));
  while (static_cast<int>(threads_.size()) + 1 < size_) threads_.emplace_back([this] { work(); });
  {
    const std::lock_guard lock(mutex_);
    task_ = &task;
    working_ = size_;
    ++tasks_;
  }
  begin_.notify_all();
  attempt();
  std::unique_lock lock(mutex_);
  end_.wait(lock, [this] { return working_ == 0; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void Crew::work() {
  long done = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      begin_.wait(lock, [&] { return over_ || tasks_ > done; });
      if (over_) return;
      done = tasks_;
    }
    attempt();
  }
}

void Crew::attempt() {
  std::exception_ptr error;
  try {
    (*task_)();
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (error && !error_) error_ = error;
  if (--working_ == 0) end_.notify_all();
}

}  // namespace signorini
