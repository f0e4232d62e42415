#pragma once

namespace signorini {

/// For programs that solve: freed memory stays with the process. What one level of a hierarchy returns serves the next
/// one, where new pages would have to be fetched from the system and zeroed.
void keep_freed_memory();

/// Gives back to the system what is free now: what comes next is of other sizes, does not fit into the gaps, and would
/// come on top of them.
void give_freed_memory_back();

}  // namespace signorini
