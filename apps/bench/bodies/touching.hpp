#pragma once

namespace signorini::bench {

/// Of two elastic bodies in contact with each other, as a table: the whole solve over linear multigrid for the same
/// bodies glued together where they touch, what part of it the coupling takes, and peak memory over that of the bodies
/// alone.
/// @param quick leaves out the largest size
void print_touching(bool quick);

}  // namespace signorini::bench
