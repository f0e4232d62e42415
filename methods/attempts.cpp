#include "methods/attempts.hpp"

#include <new>
#include <vector>

#include "core/base/error.hpp"

namespace signorini {

using automatic::Keep;

namespace {

void drop(std::vector<Stage>& stages) {
  for (Stage& stage : stages) stage.kept = false;
}

}  // namespace

Stage failed_stage(std::string method, double seconds, std::string reason) {
  Stage stage;
  stage.method = std::move(method);
  stage.seconds = seconds;
  stage.reason = std::move(reason);
  stage.kept = false;
  return stage;
}

std::string failure() {
  try {
    throw;
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted) throw;
    return error.what();
  } catch (const std::bad_alloc&) {
    return "out of memory";
  }
}

bool Attempts::keeps(Keep keep, const Summary& found) const {
  switch (keep) {
    case Keep::always:
      return true;
    case Keep::solved:
      return found.converged() || found.outcome == Outcome::interrupted;
    case Keep::better:
      return !begun_ || found.outcome == Outcome::converged || !done_.converged();
    case Keep::never:
      return false;
  }
  return false;
}

/// Of what is always kept, or looked at in any case, errors count.
void Attempts::fail(const automatic::Attempt& attempt, double seconds) {
  if (attempt.keep == Keep::always || attempt.keep == Keep::never) throw;
  done_.stages.push_back(failed_stage(attempt.method, seconds, failure()));
  done_.stages.back().linear = attempt.solver;
  error_ = std::current_exception();
}

void Attempts::take(Summary found, automatic::Start start, bool kept) {
  if (kept && begun_ && start == automatic::Start::last) return done_.append(std::move(found));
  if (kept) {
    drop(done_.stages);
    found.put_in_front(std::move(done_.stages));
    done_ = std::move(found);
    begun_ = true;
  } else {
    drop(found.stages);
    done_.stages.insert(done_.stages.end(), found.stages.begin(), found.stages.end());
  }
}

Summary Attempts::result() {
  if (!begun_ && error_) std::rethrow_exception(error_);
  return std::move(done_);
}

}  // namespace signorini
