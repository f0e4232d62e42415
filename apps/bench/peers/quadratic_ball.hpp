#pragma once
#include <string>

namespace signorini::bench {

/// Prints the ball of quadratic elements beside CalculiX and GetFEM, which get the very mesh, where their programs are
/// there: seconds, and errors of force and pressure.
/// @param quick leaves out the mesh with 300 000 unknowns
/// @param only peers whose name has this text; empty: all
void print_quadratic_ball(bool quick, const std::string& only);

}  // namespace signorini::bench
