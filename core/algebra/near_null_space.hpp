#pragma once
#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Directions of little energy that coarser levels have to represent, such as the motions of a rigid body.
struct NearNullSpace {
  Index modes = 0;            ///< none: nothing is known, and levels represent constants
  std::vector<double> value;  ///< per unknown one number for each mode; in global coordinates
  /// Per node (vectors that belong together) the part it is in, where each part has the modes by itself; empty: all
  /// nodes have them together.
  std::vector<Index> part = {};

  const double* at(Offset unknown) const { return value.data() + unknown * modes; }
  double* at(Offset unknown) { return value.data() + unknown * modes; }
};

/// More than an aggregate of vectors can tell apart.
inline constexpr Index most_modes = 32;

/// Translations and infinitesimal rotations of B components in B dimensions, 1, 3 or 6 of them.
/// @param coordinates B per vector, in any unit
template <int B>
NearNullSpace rigid_body_modes(std::span<const double> coordinates);

}  // namespace signorini
