#pragma once
#include "core/fem/assembly/elastic_matrix.hpp"
#include "core/fem/elements/checked_element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/model/material.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {

/// entry += measure * (block of the basis functions with gradients g, row, and h, column)
template <int D>
inline void add_block(const Material<D>& material, double measure, const Point<D>& g, const Point<D>& h,
                      double* entry) {
  const double lambda = measure * material.lambda, mu = measure * material.mu, shear = mu * dot(g, h);
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) entry[i * D + j] += lambda * g[i] * h[j] + mu * g[j] * h[i];
    entry[i * D + i] += shear;
  }
}

/// What hoop strains add to it: those of the basis functions are `row` and `column` per radial displacement.
template <int D>
inline void add_hoop(const Material<D>& material, double measure, double row, double column, const Point<D>& g,
                     const Point<D>& h, double* entry) {
  const double lambda = measure * material.lambda;
  for (int i = 0; i < D; ++i) {
    entry[i] += lambda * row * h[i];
    entry[i * D] += lambda * column * g[i];
  }
  entry[0] += (lambda + 2 * measure * material.mu) * row * column;
}

/// The same of an orthotropic material.
template <int D>
inline void add_block(const ElasticMatrix<D>& C, double measure, double row, double column, const Point<D>& g,
                      const Point<D>& h, double* entry) {
  for (int j = 0; j < D; ++j) {
    const StrainVector<D> stress = product<D>(C, strain_of<D>(h, column, j));
    for (int i = 0; i < D; ++i) entry[i * D + j] += measure * dot(strain_of<D>(g, row, i), stress);
  }
}

/// An elastic element at the points of a rule: what its material, its thermal strain and its basis functions are there.
/// The load is integrated at the points of the stiffness, so that what is free to expand has no stress.
template <int D, int P>
class ElementPoints {
 public:
  ElementPoints(const Nodes<D>& nodes, const Model<D>& model)
      : nodes_(nodes),
        model_(model),
        law_(model),
        orthotropic_(model),
        thermal_(model),
        axisymmetric_(D == 2 && model.plane == Plane::axisymmetric) {
    if (law_.constant()) material_.fill(own_part(law_.at({}), law_.at({})));
  }

  void move_to(std::size_t e, bool with_thermal_stress = false) {
    const auto& vertices = nodes_.template elements<P>()[e];
    const ElementMap<D, D, P> map(nodes_.mesh(), vertices);
    const bool constant = law_.constant() && orthotropic_.constant() && (!with_thermal_stress || thermal_.constant());
    is_orthotropic_ = orthotropic_.acts_in(region_of(e));
    const auto rule = stiffness_rule<D, P>(constant && !map.curved() && !axisymmetric_);
    size_ = rule.size();
    for (std::size_t q = 0; q < size_; ++q) {
      const auto& [barycentric, weight] = rule[q];
      const LinearElement<D> flat = checked_element(map, barycentric, model_.origin);
      measure_[q] = P == 1 ? flat.measure : weight * flat.measure;
      gradient_[q] = basis_gradients<P>(flat.gradient, barycentric);
      if (P == 2 && axisymmetric_) {
        const Point<D> x = map(barycentric);
        measure_[q] *= circumference<D>(model_.plane, x);
        hoop_[q] = hoop_values<P, D>(model_.plane, x, barycentric);
      }
      if (law_.constant() && !is_orthotropic_ && !with_thermal_stress) continue;
      const Site where =
          P == 1 ? site_in(nodes_.mesh(), e, model_.t) : site_in<D>(nodes_, e, map(barycentric), model_.t);
      if (!law_.constant()) material_[q] = own_part(law_.at(where), P == 1 ? law_.at(where) : at_centroid(e, map));
      if (is_orthotropic_) matrix_[q] = orthotropic_.at(where);
      if (is_orthotropic_ && with_thermal_stress)
        thermal_vector_[q] = product<D>(matrix_[q], expansion<D>(thermal_.at(where)));
      else if (with_thermal_stress)
        thermal_stress_[q] = thermal_stress(material_[q], thermal_.at(where), has_plane_stress(model_));
    }
    if constexpr (P == 1) {
      measure_[0] *= mean_circumference<D>(model_.plane, nodes_.mesh(), vertices);
      hoop_[0].fill(hoop_factor<D>(model_.plane, nodes_.mesh(), vertices) / (D + 1));
    }
  }

  /// Adds the block of the element's basis functions a, row, and b, column.
  void add_block(std::size_t a, std::size_t b, double* entry) const {
    if (is_orthotropic_) {
      for (std::size_t q = 0; q < size_; ++q)
        signorini::add_block<D>(matrix_[q], measure_[q], hoop(q, a), hoop(q, b), gradient_[q][a], gradient_[q][b],
                                entry);
      return;
    }
    for (std::size_t q = 0; q < size_; ++q)
      signorini::add_block<D>(material_[q], measure_[q], gradient_[q][a], gradient_[q][b], entry);
    for (std::size_t q = 0; axisymmetric_ && q < size_; ++q)
      add_hoop<D>(material_[q], measure_[q], hoop_[q][a], hoop_[q][b], gradient_[q][a], gradient_[q][b], entry);
  }

  /// Adds the integral of the thermal stress times the strains of the basis function a.
  void add_thermal_load(std::size_t a, double* load) const {
    if (is_orthotropic_) {
      for (std::size_t q = 0; q < size_; ++q)
        for (int i = 0; i < D; ++i)
          load[i] += measure_[q] * dot(thermal_vector_[q], strain_of<D>(gradient_[q][a], hoop(q, a), i));
      return;
    }
    for (std::size_t q = 0; q < size_; ++q) {
      const double stress = measure_[q] * thermal_stress_[q];
      for (int i = 0; i < D; ++i) load[i] += stress * gradient_[q][a][i];
      if (axisymmetric_) load[0] += stress * hoop_[q][a];
    }
  }

 private:
  static constexpr std::size_t most = most_stiffness_points<D, P>;

  double hoop(std::size_t q, std::size_t a) const { return axisymmetric_ ? hoop_[q][a] : 0; }
  Index region_of(std::size_t e) const {
    if (P == 1) return nodes_.mesh().region.empty() ? -1 : nodes_.mesh().region[e];
    return nodes_.region(e);
  }
  Material<D> at_centroid(std::size_t e, const ElementMap<D, D, P>& map) const {
    return law_.at(site_in<D>(nodes_, e, map(barycentre<D>()), model_.t));
  }
  // Of an element's material, with that at its centroid.
  Material<D> own_part(const Material<D>& material, const Material<D>& of_element) const {
    return has_pressure(model_, of_element) ? of_displacements(material) : material;
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const MaterialLaw<D> law_;
  const OrthotropicLaw<D> orthotropic_;
  const ThermalStrain<D> thermal_;
  const bool axisymmetric_;
  bool is_orthotropic_ = false;
  std::size_t size_ = 0;
  std::array<double, most> measure_, thermal_stress_;
  std::array<std::array<double, element_nodes<D, P>>, most> hoop_;  // of axisymmetric bodies
  std::array<std::array<Point<D>, element_nodes<D, P>>, most> gradient_;
  std::array<Material<D>, most> material_;
  std::array<ElasticMatrix<D>, most> matrix_;         // of orthotropic material, in place of it
  std::array<StrainVector<D>, most> thermal_vector_;  // likewise
};

}  // namespace signorini
