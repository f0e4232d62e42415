#pragma once

namespace signorini::bench {

/// Prints seconds, and errors of the normal and the tangential force, of CalculiX and of this project's solver on the
/// same meshes of a block with friction. Error(Exit::input) where there is no program `ccx`.
void print_calculix(bool quick);

}  // namespace signorini::bench
