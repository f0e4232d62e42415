#pragma once
#include <algorithm>

#include "core/fem/model/model.hpp"

namespace signorini {

/// Linear elasticity: stress = lambda tr(strain) I + 2 mu strain; in plane stress lambda is the reduced one.
template <int B>
struct Material {
  double lambda, mu;
};

template <>
struct Material<1> {
  double diffusion;
};

/// lambda over mu above which material is nearly incompressible: that of Poisson's ratio 0.4, where a pressure with
/// unknowns of its own begins to save cycles (docs/measured/rubber.md).
inline constexpr double nearly_incompressible = 4;
/// The part of lambda, over mu, that stays with the displacements where the pressure has unknowns of its own: those
/// carry the rest. More of it is worse for smoothers, less of it for the pressures' iteration (docs/theory/rubber.md).
inline constexpr double lambda_of_displacements = 3;

/// Whether the stress across the plane vanishes.
template <int B>
bool has_plane_stress(const Model<B>& model) {
  return B == 2 && model.plane == Plane::stress;
}

/// Whether the pressure of an element has unknowns of its own.
/// @param material at the element's centroid
template <int B>
bool has_pressure(const Model<B>& model, const Material<B>& material) {
  constexpr double above = 1 + 1e-9;  // Poisson's ratio 0.4 itself is not, whatever rounding makes of it
  return model.pressure != Pressure::none && !has_plane_stress(model) &&
         material.lambda > above * nearly_incompressible * material.mu;
}

/// What such a material is to the displacements, and what of lambda is left to the pressure.
template <int B>
Material<B> of_displacements(const Material<B>& material) {
  return {std::min(material.lambda, lambda_of_displacements * material.mu), material.mu};
}
template <int B>
double lambda_of_pressure(const Material<B>& material) {
  return material.lambda - of_displacements(material).lambda;
}

/// The normal stress, the same along all axes, of a body that is kept from expanding by `strain` in all directions; in
/// plane stress from doing so in the plane.
template <int B>
double thermal_stress(const Material<B>& material, double strain, bool plane_stress) {
  return ((plane_stress ? 2 : 3) * material.lambda + 2 * material.mu) * strain;
}

/// The strain of a body that is free to expand, the same in all directions: its coefficient of expansion times the
/// change of its temperature.
template <int B>
class ThermalStrain {
 public:
  explicit ThermalStrain(const Model<B>& model) : expansion_(model.expansion), temperature_(model.temperature) {}
  bool none() const { return expansion_.constant() == 0.0 || temperature_.constant() == 0.0; }
  bool constant() const { return none() || (expansion_.constant() && temperature_.constant()); }
  double at(const Site& site) const { return none() ? 0 : expansion_(site) * temperature_(site); }

 private:
  const Field &expansion_, &temperature_;
};

/// The material of a model at a point. Constants are evaluated and checked once; an expression whose value is out of
/// range (diffusion <= 0, young <= 0, poisson outside (-1, 1/2)) is an Error(Exit::input) that names its origin, value
/// and position.
template <int B>
class MaterialLaw {
 public:
  explicit MaterialLaw(const Model<B>& model);
  bool constant() const { return constant_; }
  Material<B> at(const Site& site) const { return constant_ ? fixed_ : evaluate(site); }

 private:
  Material<B> evaluate(const Site& site) const;

  const Model<B>& model_;
  bool constant_;
  Material<B> fixed_{};
};

}  // namespace signorini
