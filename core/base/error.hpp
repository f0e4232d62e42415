#pragma once
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace signorini {

/// Exit status of the program, see `signorini --help`.
enum class Exit : int {
  solved = 0,
  usage = 1,
  input = 2,
  not_converged = 3,
  no_solution = 4,
  plugin = 5,
  interrupted = 130
};

/// An error the user can mend. The message names the place, what was found and what was expected.
/// Program bugs are assertions, never this.
class Error : public std::runtime_error {
 public:
  Error(Exit status, const std::string& message) : std::runtime_error(message), status_(status) {}
  Exit status() const noexcept { return status_; }

 private:
  Exit status_;
};

/// Throws Error(Exit::input, "PLACE: MESSAGE"); `place` is a file with a line or a key.
[[noreturn]] void input_error(std::string_view place, std::string_view message);

/// ", did you mean 'NAME'?" for the candidate nearest to `name` by edit distance, or "" when none is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

}  // namespace signorini
