#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace signorini::chart {

/// How a run of this program in a process of its own ended.
struct Ended {
  bool well = false;
  std::string reason;  ///< where it did not: its message, or that its time was over
};

/// Runs this program and waits for it, for so many seconds. What it prints is not shown.
/// Error(Exit::interrupted) when the user asked to end, Error(Exit::input) where no process can be started.
/// @param log where its messages go, until they are read
Ended run_self(const std::vector<std::string>& arguments, double seconds, const std::filesystem::path& log);

}  // namespace signorini::chart
