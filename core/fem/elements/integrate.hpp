#pragma once
#include <span>
#include <vector>

#include "core/fem/elements/element.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/model/model.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {

/// A point of a quadrature rule on a face or an element with so many nodes.
template <int D, std::size_t N>
struct IntegrationPoint {
  Point<D> x;
  Point<D> normal;              ///< the outer unit normal of a face, of a curved one that at x; zero inside
  double weight;                ///< with the measure at x; of an axisymmetric body with that of its circle, too
  std::array<Index, N> node;    ///< of the face or element
  std::array<double, N> value;  ///< of their basis functions
};

namespace integration {

/// On a simplex of dimension K; `simple`: a constant times a basis function, on straight edges. The circumference of an
/// axisymmetric body is one degree more.
template <int D, int K, int P>
std::span<const QuadraturePoint<K>> rule_for(bool simple, bool axisymmetric) {
  if (axisymmetric) return simple && P == 1 ? quadrature2<K>() : quadrature5<K>();
  if (simple) return P == 1 ? midpoint_rule<K>() : quadrature2<K>();
  return P == 1 && K == D ? quadrature2<K>() : quadrature5<K>();
}

/// On the simplex of dimension K whose nodes of order P are these vertices.
template <int D, int K, int P, class Measure, class Use>
void on_simplex(const Nodes<D>& nodes, Plane plane, bool constant,
                const std::array<Index, element_nodes<K, P>>& vertices, const Measure& measure, const Use& use) {
  const ElementMap<D, K, P> map(nodes.mesh(), vertices);
  IntegrationPoint<D, element_nodes<K, P>> point;
  point.node = nodes.of(vertices);
  const bool simple = constant && !map.curved();
  for (const auto& [barycentric, weight] : rule_for<D, K, P>(simple, plane == Plane::axisymmetric)) {
    point.x = map(barycentric);
    point.normal = {};
    point.weight = weight * measure(map.flat(barycentric), point.normal) * circumference<D>(plane, point.x);
    point.value = basis<P>(barycentric);
    use(point);
  }
}

}  // namespace integration

/// Calls use(IntegrationPoint) on faces of elements of order P, by a rule that integrates products of quartic functions
/// with one on linear elements; of quadratic ones those of cubic functions with basis functions.
/// @param faces numbers of boundary faces of the mesh, all or none of those that make a face of an element
/// @param constant what basis functions are multiplied with is constant: fewer points are enough
template <int D, int P, class Use>
void integrate_faces(const Nodes<D>& nodes, Plane plane, const std::vector<Index>& faces, bool constant,
                     const Use& use) {
  const auto measure = [](const auto& corner, Point<D>& normal) {
    normal = area_normal(corner);
    return normalise(normal);
  };
  for (std::size_t k = 0; k < faces.size(); k += static_cast<std::size_t>(nodes.faces_per_element()))
    integration::on_simplex<D, D - 1, P>(nodes, plane, constant, nodes.template element_face<P>(faces[k]), measure,
                                         use);
}

/// The same on elements, by a rule that on linear ones is exact for linear functions.
/// @param regions the first and the last whose elements count; -1: all
template <int D, int P, class Use>
void integrate_elements(const Nodes<D>& nodes, Plane plane, const std::array<Index, 2>& regions, bool constant,
                        const Use& use) {
  const auto measure = [](const auto& corner, const Point<D>&) { return linear_element(corner).measure; };
  const auto& elements = nodes.template elements<P>();
  const auto [first, last] = regions;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (first < 0 || (nodes.region(e) >= first && nodes.region(e) <= last))
      integration::on_simplex<D, D, P>(nodes, plane, constant, elements[e], measure, use);
}

}  // namespace signorini
