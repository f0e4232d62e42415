#pragma once
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/dot.hpp"

namespace signorini {

/// How a Krylov method is to end, and how it did.
struct KrylovLimits {
  double tolerance = 1e-8;  ///< of the residual over that of zero
  int restart = 30;         ///< so many directions are kept, two vectors each
  int most = 60;            ///< applications of the preconditioner
};
struct KrylovResult {
  int applications = 0;
  double residual = 1;  ///< over that of zero
};

/// Solves K x = b from x = 0, where K may have no symmetry and the preconditioner may differ from one application to
/// the next: FGMRES (Saad, SIAM J. Sci. Comput. 14, 1993, Algorithm 2.2), with modified Gram-Schmidt.
/// @param apply, precondition (v, result): result = K v, and about K^-1 v
KrylovResult flexible_gmres(const std::function<void(const std::vector<double>&, std::vector<double>&)>& apply,
                            const std::function<void(const std::vector<double>&, std::vector<double>&)>& precondition,
                            const std::vector<double>& b, std::vector<double>& x, const KrylovLimits& limits);

}  // namespace signorini
