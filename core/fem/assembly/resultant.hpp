#pragma once
#include <type_traits>

#include "core/fem/elements/select_nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// Calls use(IntegrationPoint) wherever a load acts: on its faces, edges or points, or in its elements.
template <int D, int B, class Use>
void integrate_load(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, bool constant, const Use& use) {
  with_order(nodes, [&](auto order) {
    if (load.on)
      integrate_selection<D, order>(nodes, model.plane, *load.on, model.t, constant, use);
    else
      integrate_elements<D, order>(nodes, model.plane, load.regions, constant, use);
  });
}

/// The load by its value at each place, where it is given in total: force / A + w x (x - c), with the measure A and the
/// centroid c of what it acts on. w is such that the moment about the given point is that of Resultant. Forces at nodes
/// then sum to the total up to rounding, of curved faces, too. Of a body of which planes of symmetry leave a part, A, c
/// and the total are those of the whole, as far as the load goes on beyond the planes: see planes_across().
/// Error(Exit::input) for a total that is not symmetric about these.
template <int D, int B>
Load<B> distributed(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load);

}  // namespace signorini
