#pragma once
#include "apps/bench/peers/active_set.hpp"

namespace signorini::bench {

/// A preconditioner of PETSc.
struct PetscPreconditioner {
  std::string options;  ///< of PETSc's data base: "-pc_type gamg"
  bool grid = false;    ///< its multigrid with this project's interpolations, smoothed by symmetric SOR
  bool rigid = false;   ///< rigid body modes for aggregation
};

// PETSc's options are global and MPI starts once: each of these may be called once per process.

/// Reduced-space Newton (vinewtonrsls) until the natural residual is below the tolerance.
/// @param nested from the coarsest level up, else on the finest level from P(0)
Attempt petsc_newton(const Instance& instance, const PetscPreconditioner& preconditioner, bool nested,
                     double tolerance);

/// Conjugate gradients without the bounds, until the 2-norm of the residual has dropped by the tolerance.
Attempt petsc_cg(const Instance& instance, const PetscPreconditioner& preconditioner, double tolerance);

/// Active sets with PETSc's conjugate gradients; no grid.
Attempt petsc_active_set(const Instance& instance, const PetscPreconditioner& preconditioner,
                         const ActiveSetOptions& options, double tolerance);

/// A linear system alone.
struct LinearSystem {
  SparseRows A;
  int block = 1;
  std::vector<double> coordinates;  ///< three per vector, for rigid body modes; or none
  std::vector<double> b;
};

/// z = M^-1 r
using Preconditioner = std::function<void(const double* r, double* z)>;

/// Conjugate gradients until the 2-norm of the residual has dropped by `reduction`. Seconds are those of the set-up,
/// from the rows of the matrix on; x holds them and those of the iterations.
Attempt petsc_setup(const LinearSystem& system, const PetscPreconditioner& preconditioner, double reduction);
/// The same iterations with a preconditioner that is none of PETSc's.
Attempt petsc_setup(const LinearSystem& system, const std::function<Preconditioner()>& make, double reduction);

}  // namespace signorini::bench
