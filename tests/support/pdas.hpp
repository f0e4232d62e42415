#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "tests/support/dense.hpp"

/// A reference solver that shares nothing with the project but the data: primal-dual active sets (Hintermüller, Ito and
/// Kunisch, SIAM J. Optim. 13, 2003) on the whole vector with CHOLMOD for every linear system. When the active sets
/// repeat themselves a projected Newton method with a line search (Bertsekas, SIAM J. Control Optim. 20, 1982), whose
/// energy falls in every step, takes over.
namespace signorini::test {

struct Reference {
  Eigen::VectorXd x;
  Eigen::VectorXd force;           ///< A x - b, zero away from contact
  std::vector<signed char> state;  ///< per unknown -1 at the lower bound, +1 at the upper one, 0 free, 2 prescribed
  int steps = 0;
  bool cycled = false;     ///< the active sets came back to an earlier one
  bool converged = false;  ///< the optimality conditions hold to rounding

  int active() const {
    int n = 0;
    for (const int s : state) n += s == 1 || s == -1;
    return n;
  }
};

/// The solution by the reference solver; an exception when it fails.
template <int B>
Reference reference(const DiscreteProblem<B>& problem);

}  // namespace signorini::test
