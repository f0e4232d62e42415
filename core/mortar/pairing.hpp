#pragma once

namespace signorini {

/// Along what the distance from the slave to the master is measured.
enum class Pairing {
  normal,   ///< the slave face's normal
  closest,  ///< the mean normal of the master where a slave face sees it: towards its closest point
};

}  // namespace signorini
