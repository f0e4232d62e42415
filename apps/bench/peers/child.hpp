#pragma once
#include <string>

namespace signorini::bench {

/// One run of another program.
struct ChildRun {
  bool ended_well = false;
  double seconds = 0;  ///< of processor time
};

/// Runs a shell's command line on one thread. It is ended after `limit` seconds.
ChildRun run_child(const std::string& command, double limit);

bool has_program(const std::string& name);

}  // namespace signorini::bench
