#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// A mesh as a row of layers of vertices (core/mesh/layers.hpp), each coupled to itself and to the ones next to it.
struct LayerShape {
  double across = 0;  ///< vertices of the layer that a vertex lies in, on average
  double along = 0;   ///< layers: vertices over `across`
};

template <int D>
LayerShape layer_shape(const Mesh<D>& mesh);

}  // namespace signorini
