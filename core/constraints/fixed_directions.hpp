#pragma once
#include "core/base/types.hpp"

namespace signorini {

/// Directions along which the unknowns v of one vector are prescribed: direction[k] . v = value[k]. The directions are
/// orthonormal; a direction within rounding of a coordinate axis is exactly that axis.
template <int B>
struct FixedDirections {
  Index vertex = 0;  ///< the vector, of finite elements a node
  int count = 0;
  double direction[B][B] = {};
  double value[B] = {};
  /// What each comes from, of a model its number in Model::fixes; -1: the axis of an axisymmetric body, or a plane of
  /// symmetry; less: see by_tie().
  Index fix[B] = {};

  /// Adds the condition d . v = v0 (d a unit vector), solved for the part of d that is not yet prescribed. Nothing
  /// happens where there is no such part; then what is returned says what holds instead.
  struct Found {
    Index fix = -1;  ///< the one that prescribes most of d
    double by = 0;   ///< how far its value is from v0
  };
  Found add(const double* d, double v0, Index number);
  /// Prescribes zero along all that is not prescribed yet.
  void hold_rest(Index number);
  /// Only coordinate axes.
  bool along_axes() const;
};

}  // namespace signorini
