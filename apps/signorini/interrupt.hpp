#pragma once

namespace signorini {

/// From now on the first SIGINT, SIGTERM or SIGHUP asks the program to end, a second one ends it at once. `nohup` is
/// heeded. Where a plugin does not return, so that nobody hears of the first one, the program is ended without it.
void catch_interrupts();

/// Whether the user asked to end.
bool interrupted() noexcept;

/// Error(Exit::interrupted) when the user asked to end; for the time between two phases.
void stop_if_interrupted();

}  // namespace signorini
