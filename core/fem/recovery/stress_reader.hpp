#pragma once
#include <cassert>

#include "core/fem/assembly/elastic_matrix.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/gradient.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/model/material.hpp"
#include "core/fem/recovery/stress.hpp"

namespace signorini {

template <int D>
inline Stress stress(const Material<D>& material, const Gradient<D, D>& g, double hoop, bool plane_stress) {
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

/// Of an orthotropic material.
template <int D>
inline Stress stress(const ElasticMatrix<D>& C, const Gradient<D, D>& g, double hoop, double thermal) {
  StrainVector<D> strain = expansion<D>(-thermal);
  for (int i = 0; i < D; ++i) {
    const StrainVector<D> along = strain_of<D>(g[i], i == 0 ? hoop : 0, i);
    for (std::size_t k = 0; k < along.size(); ++k) strain[k] += along[k];
  }
  const StrainVector<D> found = product<D>(C, strain);
  Stress s{};
  std::ranges::copy(found, s.begin());
  return s;
}

/// Of a linear element.
template <int D>
double hoop_strain(const Nodes<D>& nodes, const Model<D>& model, std::size_t e, const std::vector<double>& u) {
  double sum = 0;
  for (const Index p : nodes.of_simplex(e)) sum += u[Offset{p} * D];
  return sum / (D + 1) * hoop_factor<D>(model.plane, nodes.mesh(), nodes.mesh().elements[e]);
}

/// A finite element function's stress in one element after the other.
template <int D, int P>
class StressReader {
 public:
  using Barycentric = std::array<double, D + 1>;

  StressReader(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
               const OwnPressure<D>& pressure)
      : nodes_(nodes), model_(model), law_(model), orthotropic_(model), thermal_(model), u_(u), pressure_(pressure) {
    assert(P == 2 || !pressure.space);
  }

  /// At a point of an element, with the measure of the flat element that it is like there.
  struct Read {
    Stress stress;
    double measure;
  };
  Read at(std::size_t e, const ElementMap<D, D, P>& map, const Barycentric& barycentric) const {
    const LinearElement<D> flat = linear_element(map.flat(barycentric));
    const auto node = nodes_.of(nodes_.template elements<P>()[e]);
    const Gradient<D, D> g = gradient<D, D>(basis_gradients<P>(flat.gradient, barycentric), node, u_);
    const Site where = P == 1 ? site_in(nodes_.mesh(), e, model_.t) : site_in<D>(nodes_, e, map(barycentric), model_.t);
    const double hoop = P == 1 ? hoop_strain(nodes_, model_, e, u_) : hoop_at(node, map(barycentric), barycentric);
    if (orthotropic_.acts_in(where.region))
      return {stress<D>(orthotropic_.at(where), g, hoop, thermal_.at(where)), flat.measure};
    const bool own = pressure_.space && pressure_.space->unknown[e][0] >= 0;
    Material<D> material = law_.at(where);
    if (own) material = of_displacements(material);
    const bool plane_stress = has_plane_stress(model_);
    Read out{stress<D>(material, g, hoop, plane_stress), flat.measure};
    const double held = thermal_stress(material, thermal_.at(where), plane_stress);
    for (int i = 0; i < (plane_stress ? 2 : 3); ++i) out.stress[i] -= held;
    if (own)
      for (int i = 0; i < 3; ++i) out.stress[i] += pressure_.space->at(*pressure_.values, e, barycentric);
    return out;
  }

 private:
  double hoop_at(const std::array<Index, element_nodes<D, P>>& node, const Point<D>& x,
                 const Barycentric& barycentric) const {
    const auto values = hoop_values<P, D>(model_.plane, x, barycentric);
    double sum = 0;
    for (std::size_t a = 0; a < node.size(); ++a) sum += values[a] * u_[Offset{node[a]} * D];
    return sum;
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const MaterialLaw<D> law_;
  const OrthotropicLaw<D> orthotropic_;
  const ThermalStrain<D> thermal_;
  const std::vector<double>& u_;
  const OwnPressure<D>& pressure_;
};

}  // namespace signorini
