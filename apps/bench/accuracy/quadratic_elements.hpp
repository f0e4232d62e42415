#pragma once

namespace signorini::bench {

/// Quadratic elements on meshes beside linear ones with the same nodes: cycles as meshes are refined, and of the
/// largest ones the whole solve over linear multigrid-CG on the same matrix, and a cycle over its memory traffic.
void print_quadratic_elements(bool quick);

}  // namespace signorini::bench
