#pragma once
#include "core/mesh/element_map.hpp"
#include "core/mesh/red_refinement.hpp"
#include "core/mortar/side.hpp"

namespace signorini::mortar {

/// Faces of elements of order P on a side. A linear one is a face of the surface, a quadratic one is made of 2^(D-1) of
/// them that follow each other, as refinement cuts it.
template <int D, int P>
struct ElementFace {
  static constexpr int K = D - 1;
  static constexpr std::size_t nodes = element_nodes<K, P>;
  static constexpr Index parts = P == 1 ? 1 : Index{1} << K;

  Index number;

  explicit ElementFace(Index n) : number(n) {}
  static ElementFace with_part(Index face) { return ElementFace(face / parts); }
  Index part(Index child) const { return number * parts + child; }

  /// Which of the nodes is a corner of one of the parts.
  static std::size_t node(Index child, int corner) {
    return static_cast<std::size_t>(P == 1 ? corner
                                           : RedRefinement<K>::children[static_cast<std::size_t>(child)][corner]);
  }

  /// Barycentric coordinates of a point that is given by those in one of the parts.
  static std::array<double, D> coordinates(Index child, const std::array<double, D>& in_part) {
    if constexpr (P == 1) return in_part;
    std::array<double, D> out{};
    for (int i = 0; i < D; ++i) {
      const std::array<double, D> place = node_place<K>(node(child, i));
      for (int k = 0; k < D; ++k) out[k] += in_part[i] * place[k];
    }
    return out;
  }

  std::array<Index, nodes> points(const Side<D>& side) const {
    std::array<Index, nodes> out{};
    for (Index child = 0; child < parts; ++child)
      for (int i = 0; i < D; ++i) out[node(child, i)] = side.faces[part(child)][i];
    return out;
  }

  ElementMap<D, K, P> map(const Side<D>& side) const {
    std::array<Point<D>, nodes> at;
    for (Index child = 0; child < parts; ++child)
      for (int i = 0; i < D; ++i) at[node(child, i)] = side.corner[part(child)][i];
    return ElementMap<D, K, P>(at);
  }

  double area(const Side<D>& side) const {
    double sum = 0;
    for (Index child = 0; child < parts; ++child) sum += side.area[part(child)];
    return sum;
  }
};

template <int D>
Point<D> unit_normal(const std::array<Point<D>, D>& corner) {
  Point<D> out = area_normal(corner);
  const double norm = length<D>(out);
  for (double& c : out) c /= norm;
  return out;
}

/// The outer normal of what a part of a face stands for.
/// @param at coordinates in the part
/// @param direction of the line along which that is looked for
template <int D, int P>
Point<D> outer_normal(const Side<D>& side, Index part, const std::array<double, D>& at, const Point<D>& direction) {
  if (side.stands_for_surface(part)) return side.surface(part, at, direction).normal;
  const auto element = ElementFace<D, P>::with_part(part);
  const ElementMap<D, D - 1, P> map = element.map(side);
  if (!map.curved()) return side.normal[part];
  return unit_normal<D>(map.flat(ElementFace<D, P>::coordinates(part - element.part(0), at)));
}

}  // namespace signorini::mortar
