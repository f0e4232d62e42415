#pragma once

namespace signorini::bench {

/// Peak memory of the whole solve of E3 over the finest matrix in block storage, as a table.
/// @param quick leaves out the largest size
void print_memory(bool quick);

}  // namespace signorini::bench
