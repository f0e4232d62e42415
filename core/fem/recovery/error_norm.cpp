#include "core/fem/recovery/error_norm.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/fem/model/material.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {
namespace {

// The density of a(v, v) for a gradient of v.
template <int D>
double density(const Material<1>& material, const Gradient<D, 1>& g) {
  return material.diffusion * dot(g[0], g[0]);
}

template <int D>
double density(const Material<D>& material, const Gradient<D, D>& g) {
  double trace = 0, squares = 0;
  for (int i = 0; i < D; ++i) {
    trace += g[i][i];
    for (int j = 0; j < D; ++j) squares += (g[i][j] + g[j][i]) * (g[i][j] + g[j][i]) / 4;
  }
  return material.lambda * trace * trace + 2 * material.mu * squares;
}

template <int D, int P, class Use>
void each_point(const Nodes<D>& nodes, const Use& use) {
  const auto& elements = nodes.template elements<P>();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const ElementMap<D, D, P> map(nodes.mesh(), elements[e]);
    const auto node = nodes.of(elements[e]);
    for (const auto& [barycentric, weight] : quadrature5<D>()) {
      const LinearElement<D> flat = linear_element(map.flat(barycentric));
      use(e, node, barycentric, flat.gradient, weight * flat.measure, map(barycentric));
    }
  }
}

}  // namespace

template <int D, int B>
double energy_error(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const ExactGradient<D, B>& exact) {
  assert(model.plane != Plane::axisymmetric && model.orthotropic.empty());
  const MaterialLaw<B> law(model);
  double sum = 0;
  with_order(nodes, [&](auto order) {
    each_point<D, order>(nodes, [&](std::size_t number, const auto& node, const auto& barycentric,
                                    const auto& of_corners, double measure, const Point<D>& x) {
      const Gradient<D, B> g = gradient<D, B>(basis_gradients<order>(of_corners, barycentric), node, u);
      Gradient<D, B> e = exact(x);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < D; ++j) e[i][j] -= g[i][j];
      sum += measure * density<D>(law.at(site_in<D>(nodes, number, x, model.t)), e);
    });
  });
  return std::sqrt(sum);
}

template <int D, int B>
double l2_error(const Nodes<D>& nodes, const std::vector<double>& u, const ExactValue<D, B>& exact) {
  double sum = 0;
  with_order(nodes, [&](auto order) {
    each_point<D, order>(nodes, [&](std::size_t, const auto& node, const auto& barycentric, const auto&, double measure,
                                    const Point<D>& x) {
      const auto value = basis<order>(barycentric);
      std::array<double, B> e = exact(x);
      for (std::size_t a = 0; a < node.size(); ++a)
        for (int i = 0; i < B; ++i) e[i] -= value[a] * u[Offset{node[a]} * B + i];
      sum += measure * dot(e, e);
    });
  });
  return std::sqrt(sum);
}

template <int D, int B>
double max_nodal_error(const Nodes<D>& nodes, const std::vector<double>& u, const ExactValue<D, B>& exact) {
  double largest = 0;
  const std::vector<double> values = nodes.at_vertices(u, B);
  for (Index v = 0; v < nodes.mesh().vertices(); ++v) {
    std::array<double, B> e = exact(nodes.mesh().points[v]);
    for (int i = 0; i < B; ++i) e[i] -= values[Offset{v} * B + i];
    largest = std::max(largest, std::sqrt(dot(e, e)));
  }
  return largest;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                     \
  template double energy_error<D, B>(const Nodes<D>&, const Model<B>&, const std::vector<double>&,      \
                                     const ExactGradient<D, B>&);                                       \
  template double l2_error<D, B>(const Nodes<D>&, const std::vector<double>&, const ExactValue<D, B>&); \
  template double max_nodal_error<D, B>(const Nodes<D>&, const std::vector<double>&, const ExactValue<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
