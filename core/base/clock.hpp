#pragma once
#include <chrono>

namespace signorini {

/// Seconds since some fixed moment; never runs backwards.
inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace signorini
