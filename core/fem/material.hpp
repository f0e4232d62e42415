#pragma once
#include "core/fem/model.hpp"

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
