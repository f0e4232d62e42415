#include "core/fem/pairs/added_gap.hpp"

#include <algorithm>
#include <cmath>

#include "core/fem/elements/select.hpp"

namespace signorini {

template <int D>
LocalConstraint<D> asked_between(const ObstacleTerm<D>& term, const Point<D>& place, const Point<D>& normal) {
  SurfaceVertex v{};
  v.measure = 1;
  std::ranges::copy(place, v.position);
  for (int i = 0; i < D; ++i) {
    v.normal[i] = normal[i];
    v.away[i] = -normal[i];
  }
  LocalConstraint<D> constraint{};
  Status status;
  term.obstacle->assemble(&v, 1, &constraint, status);
  return status.ok() ? constraint : LocalConstraint<D>{};
}

template <int D>
double added_gap(const ObstacleTerm<D>& term, const Point<D>& place, const Point<D>& normal) {
  const LocalConstraint<D> constraint = asked_between<D>(term, place, normal);
  return constraint.directions == 1 && std::isfinite(constraint.lower[0]) ? -constraint.lower[0] : 0;
}

template <int D>
std::vector<double> added_gaps(const Nodes<D>& nodes, const ObstacleTerm<D>& term, const std::vector<Index>& faces) {
  const Surface<D> side = surface(nodes, faces);
  const std::vector<Point<D>> normals = node_normals(nodes, side);
  std::vector<double> out(nodes.mesh().points.size());
  for (std::size_t k = 0; k < normals.size(); ++k)
    out[nodes.vertex(side.nodes[k])] = added_gap<D>(term, nodes.at(side.nodes[k]), normals[k]);
  return out;
}

#define SIGNORINI_INSTANTIATE(D)                                                                          \
  template LocalConstraint<D> asked_between<D>(const ObstacleTerm<D>&, const Point<D>&, const Point<D>&); \
  template double added_gap<D>(const ObstacleTerm<D>&, const Point<D>&, const Point<D>&);                 \
  template std::vector<double> added_gaps(const Nodes<D>&, const ObstacleTerm<D>&, const std::vector<Index>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
