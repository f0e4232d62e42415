#pragma once
#include <cstdio>
#include <exception>

namespace signorini {

/// The outcome of a call across the plugin boundary; no exception crosses it.
struct Status {
  int code = 0;  ///< 0: fine; otherwise an Exit
  char message[1020] = {};

  bool ok() const { return code == 0; }
  void fail(int why, const char* text) {
    code = why;
    std::snprintf(message, sizeof message, "%s", text);
  }
};

}  // namespace signorini
