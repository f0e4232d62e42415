#pragma once

namespace signorini::bench {

/// Prints what becomes of scenes with coefficients of friction from 0 to 5: cycles, sets, how far Coulomb's law is
/// violated as friction_law.hpp judges it, and how far the solution is from that of method "newton".
/// @param quick a quarter of the unknowns in the plane, an eighth in space
void print_friction_coefficients(bool quick);

}  // namespace signorini::bench
