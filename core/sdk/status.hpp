#pragma once
#include <cstdio>
#include <exception>

#include "core/base/error.hpp"

namespace signorini {

/// The outcome of a call across the plugin boundary; no exception crosses it.
struct Status {
  int code = 0;  ///< 0: fine; otherwise an Exit
  char message[1020] = {};

  bool ok() const { return code == 0 && *message == 0; }
  /// @param why an Exit; 0, which would be none, is a fault of the plugin
  void fail(int why, const char* text) {
    code = why != 0 ? why : static_cast<int>(Exit::plugin);
    std::snprintf(message, sizeof message, "%s", text);
  }
};

}  // namespace signorini
