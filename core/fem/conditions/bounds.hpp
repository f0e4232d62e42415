#pragma once
#include "core/constraints/bound.hpp"
#include "core/fem/conditions/fixes.hpp"
#include "core/fem/conditions/paired_nodes.hpp"

namespace signorini {

/// All bounds of a model's obstacles by ascending node, without those that are infinite on both sides unless a
/// functional comes with them. An obstacle that fails is an Error with its code; a bound that no number satisfies is an
/// Error(Exit::no_solution).
/// @param numbers of each functional are appended, see Bound::data
/// @param pairing pair_bodies() of both; null where the model has no obstacle between bodies
template <int D, int B>
std::vector<Bound<B>> collect_bounds(const Nodes<D>& nodes, const Model<B>& model,
                                     std::vector<FunctionalNumbers<B>>& numbers,
                                     const PairedBodies<B>* pairing = nullptr);

/// Those of one obstacle that is not between bodies.
template <int D, int B>
std::vector<Bound<B>> bounds_of(const Nodes<D>& nodes, const Model<B>& model, Index obstacle);

/// Takes a point to where the obstacle sees it, see ObstacleTerm::moved.
template <int D, int B>
void move(const ObstacleTerm<B>& term, SurfaceVertex& point) {
  for (int i = 0; i < D && D == B; ++i) point.position[i] += term.moved[i];
}

}  // namespace signorini
