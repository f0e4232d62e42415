#pragma once
#include <filesystem>

namespace signorini::bench {

/// A quarter of a ring around the origin, x > 0, y > 0, as a Gmsh file: triangles with straight edges of 15 degrees,
/// the groups `inner` and `outer`.
void write_quarter_ring(const std::filesystem::path& file, double inner, double outer);

}  // namespace signorini::bench
