#pragma once

namespace signorini::bench {

/// Forgets what was freed and the peak so far. Bytes in use now.
double begin_measuring();
/// Bytes in use at most since then.
double peak_memory();

/// Peak memory of the whole solve of E3 over the finest matrix in block storage, as a table.
/// @param quick leaves out the largest size
void print_memory(bool quick);

}  // namespace signorini::bench
