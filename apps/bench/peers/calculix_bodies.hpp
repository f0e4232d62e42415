#pragma once

namespace signorini::bench {

/// Prints seconds and forces of CalculiX's contact by mortar and surface to surface, and of this project's solver, on
/// the same meshes of two blocks. Error(Exit::input) where there is no program `ccx`.
void print_calculix_bodies(bool quick);

}  // namespace signorini::bench
