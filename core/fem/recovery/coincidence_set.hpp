#pragma once
#include <algorithm>
#include <iterator>
#include <vector>

#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// A few much larger ones, as on a ridge of the obstacle, do not change it. Reorders them; there is at least one.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The measure of the set on which a function rests on a scalar obstacle that acts on the whole body.
///
/// What presses there is a density that does not fall to zero at the edge, as pressures between surfaces do, but ends
/// with a jump: so a node at the edge has so much of its area in the set as its force is of the density farther inside
/// over all of that area. That is off by about the square of the mesh width, where counting nodes is off by a third of
/// the width. Where all nodes in contact are at the edge, or nothing presses farther inside, nodes in contact count in
/// full.
/// @param obstacle those of its nodes count, which come by ascending vertex, with their areas and pressures
template <int D>
double coincidence_set(const Nodes<D>& nodes, Index obstacle, const std::vector<ContactNode<1>>& contact);

}  // namespace signorini
