#pragma once
#include <vector>

#include "core/mortar/creases.hpp"

namespace signorini::mortar {

/// Which faces of a side are parts of planes. A plane ends where the side does, at edges of more than largest_turn, at
/// creases, and where it goes over into something bent. Facets that turn by less stand for something round, as those do
/// that have a crease but no node inside: they are no planes.
template <int D>
class Planes {
 public:
  explicit Planes(const Creases<D>& creases);

  /// The same number for all faces of one plane; -1: the face is part of none.
  Index of(Index face) const { return plane_[face]; }

 private:
  std::vector<Index> plane_;
};

}  // namespace signorini::mortar
