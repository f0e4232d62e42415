#pragma once

namespace signorini::bench {

/// Prints what steps with a moving plane cost beside their cycles.
void print_steps(bool quick);

}  // namespace signorini::bench
