#pragma once
#include <vector>

#include "core/mesh/true_surface.hpp"
#include "core/mortar/couple.hpp"

namespace signorini::mortar {

/// A surface made ready: checked, its nodes numbered among themselves, its faces one after the other in memory.
template <int D>
struct Side {
  /// Error(Exit::input) as couple() says.
  explicit Side(const SurfaceFaces<D>& surface);

  std::span<const std::array<Index, D>> faces;
  std::vector<Index> node;                      ///< the points that are nodes of it, ascending
  std::vector<Index> number;                    ///< per point its place among them, or -1
  std::vector<std::array<Point<D>, D>> corner;  ///< per face
  std::vector<Point<D>> normal;                 ///< of length 1, outwards
  std::vector<double> area;

  /// Whether a face stands for a surface that is not flat.
  bool stands_for_surface(Index face) const { return !bent_.empty() && bent_[face]; }
  /// That surface, as surface_at() says.
  SurfacePoint<D> surface(Index face, const std::array<double, D>& barycentric, const Point<D>& direction) const;

 private:
  const Mesh<D>* undeformed_;
  std::span<const Index> in_mesh_;
  std::vector<char> bent_;             // per face; empty: none
  std::vector<Point<D>> flat_normal_;  // per face, undeformed; likewise
};

}  // namespace signorini::mortar
