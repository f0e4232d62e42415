#pragma once

namespace signorini::bench {

/// Prints meshes that are finer where the error is beside uniform ones: bounds of the energy error, and time.
void print_adaptive(bool quick);

}  // namespace signorini::bench
