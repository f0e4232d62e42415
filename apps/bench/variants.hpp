#pragma once

namespace signorini::bench {

/// Cycles and rates of the variants of the method on the spiral, the ball and the degenerate problem, as a table.
void print_variants();

}  // namespace signorini::bench
