#pragma once
#include <vector>

#include "core/mortar/side.hpp"

namespace signorini::mortar {

/// What falls back beside something else in front of the same face by this part of the face's size, behind an edge or a
/// step, is no partner of it: a face does not bend round that. More than bodies strain, less than edges turn by that
/// are meant.
inline constexpr double steepest = 0.01;

/// The edges (D = 2: nodes) along which a side is sharp: where it turns by far more than beside them. Faces of what is
/// round turn at each of their edges alike; where surfaces are known, hardly at any.
template <int D>
class Creases {
 public:
  /// Keeps a reference.
  /// @param order of the elements
  Creases(const Side<D>& side, int order);

  const Side<D>& side() const { return side_; }
  /// Of the edge opposite to one of a face's corners.
  bool is_crease(Index face, int opposite) const { return !sharp_.empty() && sharp_[seat(face, opposite)]; }
  /// The outer normal, of what a face stands for, at the middle of its edge opposite to a corner.
  Point<D> normal(Index face, int opposite) const;

 private:
  static std::size_t seat(Index face, int opposite) { return static_cast<std::size_t>(face) * D + opposite; }
  struct Joint {
    Index face[2];
    int opposite[2];
  };
  std::vector<Joint> joints() const;
  void find_sharp(const std::vector<Joint>& joints);

  const Side<D>& side_;
  const int order_;
  std::vector<char> sharp_;  // per face and corner; empty: no edge is
};

}  // namespace signorini::mortar
