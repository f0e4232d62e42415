#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// What an obstacle between bodies demands at a place of the slave where they touch, per area; no direction where it
/// fails there: solving says so.
/// @param normal outer unit one of the slave
template <int D>
LocalConstraint<D> asked_between(const ObstacleTerm<D>& term, const Point<D>& place, const Point<D>& normal);

/// What an obstacle between bodies adds to their distance at a place of the slave, by its option `gap`: its bound where
/// they touch, user's unit of length. 0 where the obstacle fails there; solving says so.
/// @param normal outer unit one of the slave
template <int D>
double added_gap(const ObstacleTerm<D>& term, const Point<D>& place, const Point<D>& normal);

/// The same per vertex of the mesh; 0 off the faces.
template <int D>
std::vector<double> added_gaps(const Nodes<D>& nodes, const ObstacleTerm<D>& term, const std::vector<Index>& faces);

}  // namespace signorini
