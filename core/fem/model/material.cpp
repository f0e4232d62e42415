#include "core/fem/model/material.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace signorini {
namespace {

[[noreturn]] void out_of_range(const Field& field, const char* name, double value, const Site& site,
                               const char* expected) {
  if (field.constant()) input_error(name, fmt::format("found {}, expected {}", value, expected));
  input_error(field.origin().empty() ? name : field.origin(),
              fmt::format("'{}' is {} at ({}, {}, {}), expected {}", field.text(), value, site.x[0], site.x[1],
                          site.x[2], expected));
}

double positive(const Field& field, const char* name, const Site& site) {
  const double value = field(site);
  if (!(value > 0)) out_of_range(field, name, value, site, "a positive number");
  return value;
}

double poisson_ratio(const Field& field, const Site& site) {
  const double value = field(site);
  if (!(value > -1 && value < 0.5)) out_of_range(field, "poisson", value, site, "a number in (-1, 0.5)");
  return value;
}

}  // namespace

template <int B>
MaterialLaw<B>::MaterialLaw(const Model<B>& model) : model_(model) {
  if constexpr (B == 1)
    constant_ = model.diffusion.constant().has_value();
  else
    constant_ = model.young.constant() && model.poisson.constant();
  if (constant_) fixed_ = evaluate({});
}

template <int B>
Material<B> MaterialLaw<B>::evaluate(const Site& site) const {
  if constexpr (B == 1) {
    return {positive(model_.diffusion, "diffusion", site)};
  } else {
    const double young = positive(model_.young, "young", site), poisson = poisson_ratio(model_.poisson, site);
    return {young * poisson / ((1 + poisson) * (has_plane_stress(model_) ? 1 - poisson : 1 - 2 * poisson)),
            young / (2 * (1 + poisson))};
  }
}

template class MaterialLaw<1>;
template class MaterialLaw<2>;
template class MaterialLaw<3>;

}  // namespace signorini
