#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Numbers of a stress or a strain: in space xx, yy, zz, xy, yz, xz; in the plane xx, yy, zz (across the plane, of a
/// body of revolution around its axis), xy. Shear strains are those of engineers, twice the tensor's.
template <int D>
inline constexpr std::size_t strain_components = D == 2 ? 4 : 6;
template <int D>
using StrainVector = std::array<double, strain_components<D>>;

/// stress = C strain, row-major, symmetric. In plane stress that of the plane, with zeros for zz.
template <int D>
using ElasticMatrix = std::array<double, strain_components<D> * strain_components<D>>;

template <int D>
StrainVector<D> product(const ElasticMatrix<D>& C, const StrainVector<D>& strain) {
  StrainVector<D> out{};
  for (std::size_t i = 0; i < strain_components<D>; ++i)
    for (std::size_t j = 0; j < strain_components<D>; ++j) out[i] += C[i * strain_components<D> + j] * strain[j];
  return out;
}

/// The strain of a displacement along axis i whose gradient is g, and that is `hoop` over the radius.
template <int D>
StrainVector<D> strain_of(const Point<D>& g, double hoop, int i) {
  if constexpr (D == 2) {
    if (i == 0) return {g[0], 0, hoop, g[1]};
    return {0, g[1], 0, g[0]};
  } else {
    if (i == 0) return {g[0], 0, 0, g[1], 0, g[2]};
    if (i == 1) return {0, g[1], 0, g[0], g[2], 0};
    return {0, 0, g[2], 0, g[1], g[0]};
  }
}

/// The same strain along all axes.
template <int D>
StrainVector<D> expansion(double strain) {
  StrainVector<D> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = strain;
  return out;
}

/// What of a model is orthotropic, at places of its mesh.
template <int D>
class OrthotropicLaw {
 public:
  explicit OrthotropicLaw(const Model<D>& model);

  bool none() const { return matrix_.empty(); }
  /// Whether it depends on the region alone.
  bool constant() const { return constant_; }
  /// Whether the material of a region is orthotropic.
  bool acts_in(Index region) const { return !none() && of(region); }
  /// Of a region that it acts in.
  ElasticMatrix<D> at(const Site& site) const;

 private:
  struct Fixed {
    std::array<double, 36> own;  // along the material's directions
    ElasticMatrix<D> matrix;     // in space, unless these depend on the place
  };

  const Orthotropy<D>* of(Index region) const { return model_.orthotropic[number(region)].get(); }
  std::size_t number(Index region) const { return static_cast<std::size_t>(region - model_.first_region); }
  ElasticMatrix<D> turned(const std::array<double, 36>& own, const std::array<std::array<double, 3>, 3>& axes) const;

  const Model<D>& model_;
  std::vector<Fixed> matrix_;  // per region
  bool constant_ = true;
};

}  // namespace signorini
