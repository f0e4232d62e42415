#pragma once
#include <array>

#include "core/base/types.hpp"

namespace signorini {

/// A piece of a smooth boundary: a cubic curve (D = 2) or a cubic triangle (D = 3) in Bernstein's form. Its parameters
/// are barycentric coordinates of a flat face.
template <int D>
struct CubicPatch {
  static constexpr std::size_t size = D == 2 ? 4 : 10;

  /// Exponents of the barycentric coordinates that belong to each control point: the corners first, then two of each
  /// edge 01, 02 (, 12), nearest to the edge's first end first, then (D = 3) the one in the middle.
  static constexpr std::array<std::array<int, D>, size> exponents() {
    if constexpr (D == 2)
      return {{{3, 0}, {0, 3}, {2, 1}, {1, 2}}};
    else
      return {{{3, 0, 0},
               {0, 3, 0},
               {0, 0, 3},
               {2, 1, 0},
               {1, 2, 0},
               {2, 0, 1},
               {1, 0, 2},
               {0, 2, 1},
               {0, 1, 2},
               {1, 1, 1}}};
  }

  std::array<Point<D>, size> control{};

  Point<D> at(const std::array<double, D>& barycentric) const;

  struct Derivatives {
    Point<D> value{};
    std::array<Point<D>, D> first{};                  ///< by each barycentric coordinate, as if they were independent
    std::array<std::array<Point<D>, D>, D> second{};  ///< likewise
  };
  Derivatives derivatives(const std::array<double, D>& barycentric) const;
  /// The same surface over a part of the flat face.
  /// @param corner of the part, in barycentric coordinates
  CubicPatch part(const std::array<std::array<double, D>, D>& corner) const;
};

/// The straight one between corners.
template <int D>
CubicPatch<D> flat_patch(const std::array<Point<D>, D>& corner);

/// The one whose edges leave its ends in given directions.
/// @param tangent [from][to] of an edge's end `from` towards `to`: the derivative there where the edge's parameter runs
///   from 0 to 1. In 3D the middle is such that quadratic triangles are met exactly (Farin; Vlachos et al., Curved PN
///   Triangles, 2001)
template <int D>
CubicPatch<D> patch_with_tangents(const std::array<Point<D>, D>& corner,
                                  const std::array<std::array<Point<D>, D>, D>& tangent);

}  // namespace signorini
