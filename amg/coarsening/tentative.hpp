#pragma once
#include "amg/coarsening/aggregates.hpp"
#include "core/algebra/near_null_space.hpp"

namespace signorini {

/// Interpolation that is not smooth: every mode of a near null space, cut off at the borders of an aggregate, is one
/// component of the coarse vectors that stand for the aggregate.
struct Tentative {
  Index per_aggregate = 0;    ///< coarse vectors, ceil(modes / B)
  std::vector<double> block;  ///< per fine vector, for each coarse vector of its aggregate, B * B row-major
  NearNullSpace coarse;       ///< what interpolates to the modes given
};

/// By a QR factorisation per aggregate (Vanek, Mandel, Brezina, Computing 56, 1996, algorithm 4.1), scaled such that a
/// translation stays one: Q by the root of the number of nodes. Modes that depend on others on an aggregate, such as
/// the rotation about the line that its nodes lie on, have no coarse component there: zero columns.
/// @param group fine vectors that belong to one node of the aggregates, consecutive
template <int B>
Tentative tentative_interpolation(const NearNullSpace& fine, Index group, const Aggregates& aggregates);

}  // namespace signorini
