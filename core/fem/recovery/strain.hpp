#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// Principal strains of more than this, stretching or pressing, are large: linear elasticity is off by as much.
inline constexpr double large_strain = 0.2;

/// How small the strains of a displacement are, which linear elasticity takes them to be; at the centroids of elements.
template <int D>
struct StrainSizes {
  double largest = 0;  ///< principal strain of the largest magnitude, with its sign; of small ones a bound
  Point<D> place{};    ///< of that one
  double large = 0;    ///< part of a body's volume where principal strains are large
  double folded = 0;   ///< part where lengths become negative: with a principal strain below -1
};

/// Of several bodies the parts are those of the one with most.
/// @param of_vertex per vertex the number of its body; none: there is one
/// @param u displacements in global coordinates, D per node
template <int D>
StrainSizes<D> strain_sizes(const Nodes<D>& nodes, Plane plane, const std::vector<Index>& of_vertex,
                            const std::vector<double>& u);

}  // namespace signorini
