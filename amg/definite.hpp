#pragma once
#include <functional>
#include <memory>
#include <span>

#include "core/solver/components.hpp"

namespace signorini {

/// Error(Exit::input) where a direction d with d'Ad < 0 is found: by a few conjugate gradient steps on every level, so
/// that rough directions show on the finest and smooth ones on the coarser levels. No proof that there is none.
/// @param prolongations coarsest first
template <int B>
void refuse_indefinite(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                       const std::function<std::unique_ptr<Transfer<B>>()>& transfer);

}  // namespace signorini
