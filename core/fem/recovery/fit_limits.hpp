#pragma once
#include <cstddef>

/// How far the fits look that find pressures and tractions at the nodes of contact.
namespace signorini {

inline constexpr int rings = 3;         // of neighbours that a fit looks at
inline constexpr int rings_beyond = 5;  // the same at the edge, where it goes on from further inside
inline constexpr int most_rings = 6;    // where there are few samples
inline constexpr double excess = 1.25;  // over the means around a node: a linear pressure at a corner has less
// Samples that a fit looks for, and without which it does not go on to the edge.
template <int D>
inline constexpr std::size_t enough = D == 2 ? 4 : 12;

}  // namespace signorini
