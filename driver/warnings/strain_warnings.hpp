#pragma once
#include <string>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/fem/recovery/strain.hpp"
#include "core/io/warning.hpp"

namespace signorini {

/// Those of a model's bodies.
template <int D>
StrainSizes<D> strains(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u);

/// Error(Exit::input) where much of a body is pressed through itself: what linear elasticity says then is nonsense.
/// With neither obstacles nor prescribed motions all is proportional to the loads, and results may be meant to be
/// scaled: these are warned of.
template <int D>
void refuse_folded(const Nodes<D>& coarsest, const Model<D>& model, const StrainSizes<D>& strains);

/// Strains that are large in a noticeable part of a body.
template <int D>
Warnings strain_warnings(const Model<D>& model, const StrainSizes<D>& strains);

}  // namespace signorini
