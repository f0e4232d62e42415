#include "core/fem/error_norm.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/fem/material.hpp"
#include "core/fem/quadrature.hpp"

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

}  // namespace

template <int D, int B>
double energy_error(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const ExactGradient<D, B>& exact) {
  assert(model.plane != Plane::axisymmetric);
  const Mesh<D>& mesh = nodes.mesh();
  const MaterialLaw<B> law(model);
  double sum = 0;
  for (std::size_t number = 0; number < mesh.elements.size(); ++number) {
    const Simplex<D>& vertices = mesh.elements[number];
    const LinearElement<D> element = linear_element(mesh, vertices);
    const Gradient<D, B> g = gradient<D, B>(element, nodes.of_element(number), u);
    for (const auto& [barycentric, weight] : quadrature5<D>()) {
      const Point<D> x = combine<D>(mesh, vertices, barycentric);
      Gradient<D, B> e = exact(x);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < D; ++j) e[i][j] -= g[i][j];
      sum += weight * element.measure * density<D>(law.at(site_in<D>(mesh, number, x, model.t)), e);
    }
  }
  return std::sqrt(sum);
}

template <int D, int B>
double max_nodal_error(const Nodes<D>& nodes, const std::vector<double>& u, const ExactValue<D, B>& exact) {
  double largest = 0;
  for (Index p = 0; p < nodes.size(); ++p) {
    std::array<double, B> e = exact(nodes.at(p));
    for (int i = 0; i < B; ++i) e[i] -= u[Offset{p} * B + i];
    largest = std::max(largest, std::sqrt(dot(e, e)));
  }
  return largest;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                \
  template double energy_error<D, B>(const Nodes<D>&, const Model<B>&, const std::vector<double>&, \
                                     const ExactGradient<D, B>&);                                  \
  template double max_nodal_error<D, B>(const Nodes<D>&, const std::vector<double>&, const ExactValue<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
