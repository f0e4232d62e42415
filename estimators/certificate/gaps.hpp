#pragma once
#include <array>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/sdk/friction.hpp"
#include "estimators/certificate/incidence.hpp"
#include "estimators/certificate/reasons.hpp"

namespace signorini {

/// What one obstacle demands of a function: lower <= direction . v <= upper in the body, or on the faces it acts on.
/// Bounds between vertices are quadratic in each element: their values at vertices, and coefficients of the bubbles b =
/// 4 phi_a phi_b of edges. A quadratic function is not negative where no Bernstein coefficient is: those of an edge are
/// (w_a + w_b) / 2 + 2 w_ab, with w_ab that of the bubble.
template <int D, int B>
struct Gaps {
  struct Bound {
    std::array<double, B> direction;
    double lower, upper;  ///< of an edge those of the bubble's coefficient of `direction . v` alone
    FrictionLaw law{};    ///< of vertices: per area
  };

  std::vector<Index> of_vertex, of_edge;  ///< numbers of bounds, -1: none
  std::vector<Bound> bounds;              ///< bounds of vertices; of edges coefficients of lower and upper
  double rounding = 0;                    ///< of bounds: what is no more does not count as beyond them
  bool in_body = false;                   ///< they hold in all of the body
  bool friction = false;                  ///< bounds of vertices have a law
  std::vector<Index> faces;               ///< else: on these outer faces, numbers in Mesh::boundary

  bool any() const { return !bounds.empty(); }
  const Bound* at_vertex(Index p) const { return any() && of_vertex[p] >= 0 ? &bounds[of_vertex[p]] : nullptr; }
  const Bound* at_edge(Index e) const { return any() && of_edge[e] >= 0 ? &bounds[of_edge[e]] : nullptr; }
};

/// Of one obstacle of a model.
/// @param reasons is told where bounds are not quadratic, bounds of friction not linear, or directions not one and the
/// same
template <int D, int B>
Gaps<D, B> gaps(const Nodes<D>& nodes, const Model<B>& model, const ObstacleTerm<B>& term,
                const Incidence<D>& incidence, Reasons& reasons);

}  // namespace signorini
