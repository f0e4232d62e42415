#include "core/fem/stress.hpp"

#include <cmath>

#include "core/fem/gradient.hpp"
#include "core/fem/material.hpp"
#include "core/fem/revolution.hpp"

namespace signorini {
namespace {

template <int D>
Stress stress(const Material<D>& material, const Gradient<D, D>& g, double hoop, bool plane_stress) {
  double trace = hoop;
  for (int i = 0; i < D; ++i) trace += g[i][i];
  Stress s{};
  for (int i = 0; i < D; ++i) s[i] = material.lambda * trace + 2 * material.mu * g[i][i];
  if (D == 2 && !plane_stress) s[2] = material.lambda * trace + 2 * material.mu * hoop;
  s[3] = material.mu * (g[0][1] + g[1][0]);
  if constexpr (D == 3) {
    s[4] = material.mu * (g[1][2] + g[2][1]);
    s[5] = material.mu * (g[0][2] + g[2][0]);
  }
  return s;
}

template <int D>
double hoop_strain(const Nodes<D>& nodes, const Model<D>& model, std::size_t e, const std::vector<double>& u) {
  double sum = 0;
  for (const Index p : nodes.of_element(e)) sum += u[Offset{p} * D];
  return sum / (D + 1) * hoop_factor<D>(model.plane, nodes.mesh(), nodes.mesh().elements[e]);
}

}  // namespace

template <int D>
std::vector<Stress> element_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u) {
  const Mesh<D>& mesh = nodes.mesh();
  const MaterialLaw<D> law(model);
  std::vector<Stress> out;
  out.reserve(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Gradient<D, D> g = gradient<D, D>(linear_element(mesh, mesh.elements[e]), nodes.of_element(e), u);
    const Material<D> material = law.at(site_in(mesh, e, model.t));
    out.push_back(stress<D>(material, g, hoop_strain(nodes, model, e, u), model.plane == Plane::stress));
  }
  return out;
}

template <int D>
std::vector<Stress> nodal_stress(const Mesh<D>& mesh, const std::vector<Stress>& element_stress) {
  std::vector<Stress> out(mesh.points.size());
  std::vector<double> weight(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const double measure = linear_element(mesh, mesh.elements[e]).measure;
    for (const Index p : mesh.elements[e]) {
      for (int k = 0; k < 6; ++k) out[p][k] += measure * element_stress[e][k];
      weight[p] += measure;
    }
  }
  for (std::size_t p = 0; p < out.size(); ++p)
    if (weight[p] > 0)
      for (double& s : out[p]) s /= weight[p];
  return out;
}

double von_mises(const Stress& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

template std::vector<Stress> element_stress(const Nodes<2>&, const Model<2>&, const std::vector<double>&);
template std::vector<Stress> element_stress(const Nodes<3>&, const Model<3>&, const std::vector<double>&);
template std::vector<Stress> nodal_stress(const Mesh<2>&, const std::vector<Stress>&);
template std::vector<Stress> nodal_stress(const Mesh<3>&, const std::vector<Stress>&);

}  // namespace signorini
