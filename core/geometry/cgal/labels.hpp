#pragma once
#include <unordered_map>
#include <vector>

#include "core/geometry/cgal/mesh_domain.hpp"

namespace signorini::geometry {

/// Tells which cells are inside by their middles. That is right as long as no cell crosses the surface, and along
/// convex edges none does, however sharp they are: beyond them are no vertices that could hide a face. By the centres
/// of their spheres, as CGAL tells it, cells along a sharp edge are on the wrong side. On one curved piece of the
/// surface these make a manifold, and stay. Cells on the surface that are flat but for rounding are outside.
class LabelsByMiddles {
 public:
  LabelsByMiddles(Complex& complex, const Domain& domain, const Sizing<3>& sizing)
      : complex_(complex), domain_(domain), sizing_(sizing) {}

  void put() {
    std::vector<Cell> flat;
    for (const Cell cell : complex_.triangulation().finite_cell_handles()) {
      sizing_.count_query();
      if (is_on_curved_piece(cell)) continue;
      const auto p = corners_of(cell);
      Point<3> middle{};
      for (const Point<3>& q : p)
        for (std::size_t k = 0; k < 3; ++k) middle[k] += q[k] / 4;
      label(cell, domain_.inside(middle));
      if (complex_.is_in_complex(cell) && std::abs(relative_volume<3>(p)) < flat_cell) flat.push_back(cell);
    }
    while (std::erase_if(flat, [&](Cell cell) { return take_away(cell); }) > 0) {
    }
    for (const auto& facet : complex_.triangulation().finite_facets()) {
      const bool border =
          complex_.is_in_complex(facet.first) != complex_.is_in_complex(facet.first->neighbor(facet.second));
      if (border && !complex_.is_in_complex(facet)) complex_.add_to_complex(facet, {0, 1});
      if (!border && complex_.is_in_complex(facet)) complex_.remove_from_complex(facet);
    }
  }

 private:
  using Cell = Triangulation::Cell_handle;
  static constexpr double flat_cell = 1e-6;

  std::array<Point<3>, 4> corners_of(Cell cell) const {
    return {corner(cell, 0), corner(cell, 1), corner(cell, 2), corner(cell, 3)};
  }
  /// With all corners, but those on creases.
  bool is_on_curved_piece(Cell cell) {
    if (domain_.flat()) return false;
    std::optional<Index> piece;
    for (int i = 0; i < 4; ++i) {
      const auto vertex = cell->vertex(i);
      const int dimension = complex_.in_dimension(vertex);
      if (dimension <= 1) continue;
      if (dimension == 3) return false;
      const auto [at, fresh] = piece_.try_emplace(vertex, -1);
      if (fresh) at->second = domain_.curved_piece(corner(cell, i));
      if (at->second < 0 || at->second != piece.value_or(at->second)) return false;
      piece = at->second;
    }
    return piece.has_value();
  }
  Point<3> corner(Cell cell, int i) const {
    const auto& p = complex_.triangulation().point(cell, i);
    return {p[0], p[1], p[2]};
  }
  void label(Cell cell, bool inside) {
    if (inside == complex_.is_in_complex(cell)) return;
    if (inside)
      complex_.add_to_complex(cell, 1);
    else
      complex_.remove_from_complex(cell);
  }
  bool take_away(Cell cell) {
    bool outer = false;
    for (int i = 0; i < 4; ++i) outer = outer || !complex_.is_in_complex(cell->neighbor(i));
    if (outer) label(cell, false);
    return outer;
  }

  Complex& complex_;
  const Domain& domain_;
  const Sizing<3>& sizing_;
  std::unordered_map<Triangulation::Vertex_handle, Index, CGAL::Handle_hash_function> piece_;
};

}  // namespace signorini::geometry
