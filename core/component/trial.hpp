#pragma once
#include <functional>
#include <string>

namespace signorini {

/// Does `work` in a copy of the process first, whose end harms nobody: no handler of this process survives an assertion
/// in the loader of the system, or goes on after a crash. What the copy prints is thrown away, and so is what `work`
/// throws.
/// @param patience seconds after which the copy is ended
/// @return how the copy ended where it did not come to the end of `work`; "" where it did or no copy can be made
/// @throws Error(Exit::interrupted) when the process is to end meanwhile
std::string fatal_end(const std::function<void()>& work, double patience = 10);

}  // namespace signorini
