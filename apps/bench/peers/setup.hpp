#pragma once

namespace signorini::bench {

/// Algebraic hierarchies without any bounds: set-up and iterations of conjugate gradients with this project's levels,
/// with BoomerAMG and with GAMG on the same matrices, as a table.
/// @param quick small sizes
void print_setup(bool quick);

}  // namespace signorini::bench
