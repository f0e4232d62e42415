#pragma once
#include <memory>

#include "core/algebra/unsymmetric_solver.hpp"

namespace signorini {

std::unique_ptr<UnsymmetricSolver> new_umfpack();

}  // namespace signorini
