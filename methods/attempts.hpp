#pragma once
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.hpp"
#include "core/solver/summary.hpp"
#include "methods/stages.hpp"

namespace signorini {

/// A stage that came to nothing.
Stage failed_stage(std::string method, double seconds, std::string reason);

/// Why what threw the exception that is being handled came to nothing: an error, or memory that ran out. What is no
/// such failure, or the user's wish to end, is thrown on.
std::string failure();

/// What is done for one problem, attempt after attempt.
class Attempts {
 public:
  Attempts() = default;
  explicit Attempts(Summary done) : done_(std::move(done)), begun_(true) {}

  /// Whether something was kept.
  bool begun() const { return begun_; }
  /// Of all that was kept, with the stages of what was not.
  const Summary& done() const { return done_; }
  /// Steps of what was kept.
  int steps() const { return done_.history.empty() ? 0 : done_.history.back().iteration; }

  /// Runs an attempt, and keeps what it came to, or goes back to where it began, as its `keep` says.
  /// @param start what came before is dropped if this is kept, unless it is the last
  /// @param place has save() and restore()
  /// @param run goes to the start, leaves the solution in the place, and returns a Summary
  /// @return whether it was kept
  template <class Place, class Run>
  bool run(const automatic::Attempt& attempt, automatic::Start start, Place& place, const Run& run) {
    if (attempt.keep != automatic::Keep::always) place.save();
    const double begin = seconds();
    std::optional<Summary> found;
    try {
      found = run();
    } catch (...) {
      fail(attempt, seconds() - begin);
    }
    const bool kept = found && keeps(attempt.keep, *found);
    if (!kept) place.restore();
    if (found) take(std::move(*found), start, kept);
    return kept;
  }
  /// One that is always kept: there is no way back.
  template <class Run>
  void run(const automatic::Attempt&, automatic::Start start, const Run& run) {
    take(run(), start, true);
  }

  /// In the end. Where nothing was kept, the last error is thrown.
  Summary result();

 private:
  bool keeps(automatic::Keep keep, const Summary& found) const;
  void fail(const automatic::Attempt& attempt, double seconds);
  void take(Summary found, automatic::Start start, bool kept);

  Summary done_;
  bool begun_ = false;
  std::exception_ptr error_;
};

}  // namespace signorini
