#pragma once

namespace signorini::bench {

/// The tables of docs/measured/variants.md: cycles, rates and times of the variants of the method, and rates of
/// truncation, monotone restriction and cut, on the spiral, the ball and the degenerate problem.
void print_variants();

}  // namespace signorini::bench
