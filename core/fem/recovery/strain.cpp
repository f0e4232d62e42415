#include "core/fem/recovery/strain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/dense.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/gradient.hpp"
#include "core/fem/elements/revolution.hpp"

namespace signorini {
namespace {

/// The least and the largest one.
template <int D>
std::array<double, 2> principal_strains(const Gradient<D, D>& g, double hoop) {
  Eigen::Matrix<double, D, D> strain;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) strain(i, j) = 0.5 * (g[i][j] + g[j][i]);
  std::array<double, 2> out{std::min(hoop, 0.0), std::max(hoop, 0.0)};
  // Most elements have small strains, whose directions do not matter.
  if (const double size = strain.norm(); size <= large_strain) return {std::min(out[0], -size), std::max(out[1], size)};
  const Eigen::VectorXd values = eigenpairs(strain).values;
  return {std::min(out[0], values[0]), std::max(out[1], values[D - 1])};
}

/// Volumes of a body.
struct Parts {
  double whole = 0, large = 0, folded = 0;
};

}  // namespace

template <int D>
StrainSizes<D> strain_sizes(const Nodes<D>& nodes, Plane plane, const std::vector<Index>& of_vertex,
                            const std::vector<double>& u) {
  StrainSizes<D> out;
  std::vector<Parts> bodies(of_vertex.empty() ? 1 : std::size_t{1} + *std::ranges::max_element(of_vertex));
  with_order(nodes, [&](auto order) {
    const auto middle = barycentre<D>();
    for (const auto& vertices : nodes.template elements<order>()) {
      const ElementMap<D, D, order> map(nodes.mesh(), vertices);
      const LinearElement<D> flat = linear_element(map.flat(middle));
      const auto node = nodes.of(vertices);
      const Point<D> x = map(middle);
      const auto hoop_value = hoop_values<order, D>(plane, x, middle);
      double hoop = 0;
      for (std::size_t a = 0; a < node.size(); ++a) hoop += hoop_value[a] * u[Offset{node[a]} * D];
      const auto [least, most] =
          principal_strains<D>(gradient<D, D>(basis_gradients<order>(flat.gradient, middle), node, u), hoop);
      const double size = std::max(-least, most), volume = flat.measure * circumference<D>(plane, x);
      Parts& body = bodies[of_vertex.empty() ? 0 : of_vertex[vertices[0]]];
      body.whole += volume;
      if (size > large_strain) body.large += volume;
      if (least < -1) body.folded += volume;
      if (size <= std::abs(out.largest)) continue;
      out.largest = -least > most ? least : most;
      out.place = x;
    }
  });
  for (const Parts& body : bodies) {
    out.large = std::max(out.large, body.large / body.whole);
    out.folded = std::max(out.folded, body.folded / body.whole);
  }
  return out;
}

template StrainSizes<2> strain_sizes(const Nodes<2>&, Plane, const std::vector<Index>&, const std::vector<double>&);
template StrainSizes<3> strain_sizes(const Nodes<3>&, Plane, const std::vector<Index>&, const std::vector<double>&);

}  // namespace signorini
