#pragma once

namespace signorini {

/// Whether whoever runs the process wants it to end: a program sets it on a signal, long work that has no Progress at
/// hand looks at it.
bool interrupt_requested() noexcept;
/// May be called from the handler of a signal.
void request_interrupt() noexcept;

}  // namespace signorini
