#pragma once

namespace signorini {

/// Along what the distance from the slave to the master is measured.
enum class Pairing {
  normal,   ///< the slave face's normal; that of a plane where the face is bent and sees nothing else
  closest,  ///< the mean normal of the master where a slave face sees it: towards its closest point
};

/// Cosine of the angle to a node's normal up to which faces count as what it presses with, or as what is in front of
/// it: 60 degrees, less rounding. (Those around an edge see something else.)
inline constexpr double facing = 0.5 - 1e-9;

}  // namespace signorini
