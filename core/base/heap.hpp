#pragma once

namespace signorini {

/// For programs that solve: freed memory stays with the process. What one level of a hierarchy returns serves the next
/// one, where new pages would have to be fetched from the system and zeroed.
void keep_freed_memory();

}  // namespace signorini
