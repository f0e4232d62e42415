#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/solver/components.hpp"

namespace signorini {

/// Prolongations below the level of a problem, coarsest first, until at most `enough` vectors are left or coarsening
/// makes no progress. They continue a geometric hierarchy downwards, or are a hierarchy of their own.
/// @param transfer makes the transfers whose Galerkin products the coarser levels are chosen by
template <int B>
std::vector<Prolongation> algebraic_hierarchy(const DiscreteProblem<B>& problem,
                                              const std::function<std::unique_ptr<Transfer<B>>()>& transfer,
                                              Index enough = 400);

}  // namespace signorini
