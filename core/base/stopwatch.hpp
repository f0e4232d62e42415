#pragma once
#include "core/base/clock.hpp"

namespace signorini {

/// Seconds since its construction or the last lap().
class Stopwatch {
 public:
  double elapsed() const { return seconds() - start_; }
  double lap() {
    const double passed = elapsed();
    start_ += passed;
    return passed;
  }

 private:
  double start_ = seconds();
};

}  // namespace signorini
