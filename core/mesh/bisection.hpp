#pragma once
#include <algorithm>
#include <array>
#include <cassert>

#include "core/mesh/simplex.hpp"

/// Bisection of triangles and tetrahedra, from any conforming mesh. Each simplex knows the edge that is to be cut: its
/// first two vertices. In the plane that is opposite to the newest vertex. In space each face of a tetrahedron has a
/// marked edge as well, the same one for both elements at the face: D. N. Arnold, A. Mukherjee, L. Pouly, Locally
/// adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000) 431-448, section 2. The longest edges
/// come first. Descendants have finitely many shapes, and cutting until no element has a cut edge comes to an end.
namespace signorini {

template <int D>
struct Bisected {
  std::array<Index, D + 1> vertex;  ///< the edge to be cut joins the first two
  /// Per vertex the face of the coarsest boundary that the face opposite to it is a part of; -1: none.
  std::array<Index, D + 1> face;
  /// Of the faces opposite to the first two vertices, which do not have the edge to be cut: the vertex opposite to the
  /// marked edge. (Of the other faces that edge is the marked one.) D = 3.
  std::array<Index, 2> apex{-1, -1};
  bool flagged = false;   ///< D = 3
  bool mirrored = false;  ///< the vertices in this order are negatively oriented
};

/// Whether it takes an odd number of exchanges to make b of a.
template <std::size_t N>
bool odd(std::array<Index, N> a, const std::array<Index, N>& b) {
  bool out = false;
  for (std::size_t i = 0; i < N; ++i) {
    const auto at = static_cast<std::size_t>(std::ranges::find(a, b[i]) - a.begin());
    assert(at < N);
    if (at == i) continue;
    std::swap(a[i], a[at]);
    out = !out;
  }
  return out;
}

/// Of a positively oriented element of a coarsest mesh.
/// @param face opposite to each vertex, the boundary face; -1: none
/// @param longer longer(a, b, c, d): whether edge ab comes before edge cd: a strict order of the edges of the mesh
template <int D, class Longer>
Bisected<D> first_of_all(const Simplex<D>& element, const std::array<Index, D + 1>& face, const Longer& longer) {
  const auto longest = [&](const auto& among) {
    std::array<Index, 2> best{among[0], among[1]};
    for (std::size_t i = 0; i < among.size(); ++i)
      for (std::size_t j = i + 1; j < among.size(); ++j)
        if (longer(among[i], among[j], best[0], best[1])) best = {among[i], among[j]};
    return best;
  };
  const auto cut = longest(element);
  Bisected<D> out{.vertex = {cut[0], cut[1]}, .face = {}};
  for (int i = 0, k = 2; i <= D; ++i)
    if (std::ranges::count(cut, element[i]) == 0) out.vertex[k++] = element[i];
  for (int i = 0; i <= D; ++i)
    out.face[i] = face[static_cast<std::size_t>(std::ranges::find(element, out.vertex[i]) - element.begin())];
  if constexpr (D == 3)
    for (int i = 0; i < 2; ++i) {
      const std::array opposite{out.vertex[1 - i], out.vertex[2], out.vertex[3]};
      const auto marked = longest(opposite);
      for (const Index v : opposite)
        if (std::ranges::count(marked, v) == 0) out.apex[i] = v;
    }
  out.mirrored = odd(element, out.vertex);
  return out;
}

/// The half that keeps vertex `side` (0 or 1) of the edge that is cut at `middle`.
template <int D>
Bisected<D> half(const Bisected<D>& whole, int side, Index middle) {
  const int other = 1 - side;
  const auto& v = whole.vertex;
  // the same with the middle in place of the other end, which keeps the orientation
  std::array<Index, D + 1> vertex = v, face = whole.face;
  vertex[other] = middle;
  face[side] = -1;
  face[other] = whole.face[other];

  Bisected<D> out;
  if constexpr (D == 2) {
    out.vertex = {v[side], v[2], middle};
  } else {
    // Per vertex of the half the apex of the face opposite to it.
    std::array<Index, D + 1> apex;
    apex[other] = whole.apex[other];  // the face that is not cut
    apex[2] = apex[3] = middle;       // those that are
    const bool planar = whole.apex[0] == whole.apex[1];
    apex[side] = planar && whole.flagged ? whole.apex[0] : middle;  // the new one
    out.flagged = planar && !whole.flagged;
    // The edge marked on the face that is not cut is the next one.
    int k = 0;
    for (const Index w : {v[side], v[2], v[3]})
      if (w != apex[other]) out.vertex[k++] = w;
    out.vertex[2] = apex[other];
    out.vertex[3] = middle;
    for (int i = 0; i < 2; ++i)
      out.apex[i] = apex[static_cast<std::size_t>(std::ranges::find(vertex, out.vertex[i]) - vertex.begin())];
  }
  for (int i = 0; i <= D; ++i)
    out.face[i] = face[static_cast<std::size_t>(std::ranges::find(vertex, out.vertex[i]) - vertex.begin())];
  out.mirrored = whole.mirrored != odd(vertex, out.vertex);
  return out;
}

}  // namespace signorini
