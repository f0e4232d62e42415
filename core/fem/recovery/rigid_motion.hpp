#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"

namespace signorini {

/// How a rigid part has moved, and what moves it: user's units, radians. Of an axisymmetric body forces are those on
/// the whole, and the first entry is what holds its nodes on their circles, see Forces.
template <int B>
struct RigidMotion {
  std::array<double, B> point{};  ///< undeformed
  std::array<double, B> displacement{};
  std::array<double, RigidPart<B>::rotations> rotation{};
  /// On the part, about the point: what is applied where a component is free, and what is needed where it is
  /// prescribed.
  std::array<double, B> applied{}, reaction{};
  std::array<double, RigidPart<B>::rotations> torque{};
};

/// As Model::rigid.
/// @param x solution in local coordinates
template <int B>
std::vector<RigidMotion<B>> rigid_motions(const Model<B>& model, const Discretization<B>& discretization,
                                          const std::vector<double>& x);

}  // namespace signorini
