#pragma once
#include <string>

namespace signorini::bench {

/// Algebraic hierarchies without any bounds: set-up and iterations of conjugate gradients with this project's levels,
/// with BoomerAMG and with GAMG on the same matrices, as a table.
/// @param quick small sizes
/// @param only matrices with this text in their names
void print_setup(bool quick, const std::string& only);

}  // namespace signorini::bench
