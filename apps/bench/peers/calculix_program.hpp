#pragma once
#include <array>
#include <filesystem>
#include <optional>

namespace signorini::bench {

/// One run of CalculiX, Debian's program ccx.
struct CalculixRun {
  double seconds = 0;  ///< of processor time, one thread
  int iterations = 0;
  std::array<double, 3> force{};  ///< the last total that the deck prints
};

/// Runs a deck `folder/name.inp`. Nothing where it ends without a result, or takes more than `limit` seconds.
std::optional<CalculixRun> run_calculix(const std::filesystem::path& folder, const std::string& name, double limit);

bool has_calculix();
/// Error(Exit::input) without the program.
void require_calculix();

}  // namespace signorini::bench
