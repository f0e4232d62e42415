#pragma once

namespace signorini::bench {

/// Prints, for problems without meshes, the cycles after a change of bounds or loads: from the solution before it, and
/// from none.
void print_warm(bool quick);

}  // namespace signorini::bench
