#pragma once
#include <map>

#include "core/mesh/element_map.hpp"
#include "core/mesh/red_refinement.hpp"
#include "tests/core/mortar/surfaces.hpp"

/// Surfaces of quadratic elements.
namespace signorini::test {

template <int D>
struct QuadraticSurface {
  static constexpr int K = D - 1;
  static constexpr std::size_t nodes = element_nodes<K, 2>;

  Surface<D> cut;                                 ///< as coupling wants it
  std::vector<std::array<Index, nodes>> element;  ///< its faces
  std::vector<std::array<Index, 2>> ends;         ///< per point; twice itself for a corner

  SurfaceFaces<D> side() const {
    SurfaceFaces<D> out = cut.side();
    out.order = 2;
    return out;
  }

  /// The coefficients of a function: per point.
  template <class F>
  std::vector<double> coefficients(const F& f) const {
    std::vector<double> out;
    for (std::size_t p = 0; p < cut.points.size(); ++p) {
      const auto [a, b] = ends[p];
      const double mean = (f(cut.points[a]) + f(cut.points[b])) / 2;
      out.push_back(a == b ? mean : (f(cut.points[p]) - (1 - midpoint_weight) * mean) / midpoint_weight);
    }
    return out;
  }

  /// ∫ φ over all faces, which are flat, per point.
  std::vector<double> areas() const {
    std::vector<double> out(cut.points.size());
    std::size_t part = 0;
    for (const auto& face : element) {
      double area = 0;
      for (std::size_t child = 0; child < RedRefinement<K>::children.size(); ++child, ++part)
        area += area_of(cut.faces[part]);
      for (std::size_t p = 0; p < nodes; ++p) out[face[p]] += area * basis_mean<2, K>(p);
    }
    return out;
  }

 private:
  double area_of(const std::array<Index, D>& face) const {
    const Point<D> n = area_normal(points_of(cut.points, face));
    double square = 0;
    for (const double c : n) square += c * c;
    return std::sqrt(square);
  }
};

/// Of the faces of a linear one; the midpoints of its edges are moved by `place`.
template <int D, class Place>
QuadraticSurface<D> quadratic(const Surface<D>& linear, const Place& place) {
  constexpr int K = D - 1;
  QuadraticSurface<D> out;
  out.cut.points = linear.points;
  for (Index p = 0; p < static_cast<Index>(linear.points.size()); ++p) out.ends.push_back({p, p});
  std::map<std::array<Index, 2>, Index> middle;
  for (const auto& face : linear.faces) {
    std::array<Index, QuadraticSurface<D>::nodes> node;
    std::copy(face.begin(), face.end(), node.begin());
    constexpr auto edges = simplex_edges<K>();
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const std::array<Index, 2> ends = sorted<2>({face[edges[k][0]], face[edges[k][1]]});
      const auto [at, fresh] = middle.try_emplace(ends, static_cast<Index>(out.cut.points.size()));
      node[D + k] = at->second;
      if (!fresh) continue;
      out.cut.points.push_back(place(midpoint<D>(linear.points[ends[0]], linear.points[ends[1]])));
      out.ends.push_back(ends);
    }
    out.element.push_back(node);
    for (const auto& child : RedRefinement<K>::children) {
      std::array<Index, D> part;
      for (int i = 0; i < D; ++i) part[i] = node[child[i]];
      out.cut.faces.push_back(part);
    }
  }
  return out;
}

template <int D>
QuadraticSurface<D> quadratic(const Surface<D>& linear) {
  return quadratic(linear, [](const Point<D>& x) { return x; });
}

}  // namespace signorini::test
