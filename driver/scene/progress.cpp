#include "driver/scene/progress.hpp"

#include "core/base/error.hpp"

namespace signorini {

void Progress::step(const LoadStep&, int) const {}

void Progress::phase(const std::string&) const {}

void Progress::solving(const Goal&) const {}

void Progress::cycle(const IterationRecord&) const {}

bool Progress::interrupted() const { return false; }

bool Progress::is_ended() const {
  if (interrupted()) ended_ = true;
  return ended_;
}

void Progress::stop_if_interrupted() const {
  if (is_ended()) throw Error(Exit::interrupted, "interrupted; nothing was written");
}

}  // namespace signorini
