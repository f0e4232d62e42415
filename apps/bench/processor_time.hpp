#pragma once
#include <ctime>

namespace signorini::bench {

/// Seconds of processor time that this process has used since the construction: for one thread on an idle machine what
/// a watch shows, and hardly disturbed by what else runs.
class ProcessorTime {
 public:
  double elapsed() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
};

}  // namespace signorini::bench
