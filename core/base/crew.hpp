#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace signorini {

/// Threads that work on one task at a time and sleep in between. They are started with the first task.
class Crew {
 public:
  /// @param size number of threads, the calling one among them; at least 1
  explicit Crew(int size) : size_(size) {}
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  int size() const { return size_; }

  /// Calls task() once on every thread and returns when all calls have returned. Throws what one of them threw.
  void run(const std::function<void()>& task);

 private:
  void work();
  void attempt();

  const int size_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable begin_, end_;
  const std::function<void()>* task_ = nullptr;
  std::exception_ptr error_;
  long tasks_ = 0;   // begun so far
  int working_ = 0;  // threads that have not finished the task
  bool over_ = false;
};

}  // namespace signorini
