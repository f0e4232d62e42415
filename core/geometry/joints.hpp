#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// What flat faces have in common: vertices (D = 2), edges (D = 3). Joint `tip` of a face lies opposite to that corner;
/// lists per face and tip have that of face f at f * D + tip.
template <int D>
struct Joints {
  std::vector<Index> number;  ///< per face and tip
  Index count = 0;
  std::vector<Index> beyond;  ///< per face and tip, the face and tip on the other side; -1 where there are not just two
};

template <int D>
Joints<D> find_joints(Index vertices, const std::vector<std::array<Index, D>>& faces);

/// The vertices of joint `tip` of a face, in the order of the face.
template <int D>
std::array<Index, D - 1> joint_of(const std::array<Index, D>& face, int tip) {
  std::array<Index, D - 1> out;
  for (int i = 0; i < D - 1; ++i) out[i] = face[(tip + 1 + i) % D];
  return out;
}

}  // namespace signorini::geometry
