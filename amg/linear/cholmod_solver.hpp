#pragma once
#include <memory>

#include "core/algebra/linear_solver.hpp"
#include "core/algebra/unsymmetric_solver.hpp"

namespace signorini {

/// CHOLMOD, in a shared library of its own (signorini_cholmod, GPL) that is loaded on first use. Error(Exit::plugin)
/// where it is missing.
std::unique_ptr<LinearSolver> cholmod_solver();

/// UMFPACK, in the same library.
std::unique_ptr<UnsymmetricSolver> umfpack_solver();

}  // namespace signorini
