#pragma once

namespace signorini {

/// For programs that solve; to be called first in main(). Freed memory stays with the process: what one level of a
/// hierarchy returns serves the next one, where new pages would have to be fetched from the system and zeroed. And the
/// heap is on huge pages where the system grants them (Linux with transparent huge pages "madvise" or "always"): the
/// arrays of a large problem are spread over more small pages than the processor can look up fast. Addresses are
/// reserved for half of the machine's memory, none of which is used before it is needed; without leave for that, only
/// the first part holds.
void prepare_heap();

}  // namespace signorini
