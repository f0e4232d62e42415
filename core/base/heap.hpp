#pragma once
#include <cstddef>
#include <vector>

namespace signorini {

/// For programs that solve: freed memory stays with the process. What one level of a hierarchy returns serves the next
/// one, where new pages would have to be fetched from the system and zeroed.
void keep_freed_memory();

/// Gives back to the system what is free now: what comes next is of other sizes, does not fit into the gaps, and would
/// come on top of them.
void give_freed_memory_back();

/// Gives back to the system the whole pages of a piece of memory, which stays allocated: it may be written again.
/// What it holds is lost.
void give_pages_back(void* from, std::size_t bytes);

/// The same of what a vector has reserved and does not use: it may lie on pages that others have used before.
template <class T>
void give_unused_back(std::vector<T>& values) {
  give_pages_back(values.data() + values.size(), (values.capacity() - values.size()) * sizeof(T));
}

}  // namespace signorini
