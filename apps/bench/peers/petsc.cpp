#include "apps/bench/peers/petsc.hpp"

#include <algorithm>
#include <stdexcept>

#include "apps/bench/peers/accuracy.hpp"
#include "apps/bench/peers/petsc_objects.hpp"
#include "apps/bench/processor_time.hpp"

namespace signorini::bench {
namespace {

PetscMatrix system_matrix(const SparseRows& A, const PetscPreconditioner& preconditioner, int block,
                          const std::vector<double>& coordinates) {
  PetscMatrix out = petsc_matrix(A, block);
  check(MatSetOption(out, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(out, MAT_SPD, PETSC_TRUE));
  if (preconditioner.rigid) set_rigid_modes(out, coordinates);
  return out;
}

PetscLinear conjugate_gradients() {
  PetscLinear out;
  check(KSPCreate(PETSC_COMM_SELF, out.fresh()));
  check(KSPSetType(out, KSPCG));
  check(KSPSetNormType(out, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetFromOptions(out));
  return out;
}

int solve(KSP ksp, Vec b, Vec x, double reduction) {
  check(KSPSetTolerances(ksp, reduction, 1e-300, 1e10, 2000));
  check(KSPSolve(ksp, b, x));
  KSPConvergedReason why;
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(ksp, &why));
  check(KSPGetIterationNumber(ksp, &iterations));
  if (why < 0) throw std::runtime_error(std::string("PETSc: ") + KSPConvergedReasons[why]);
  return iterations;
}

class PetscConjugateGradients final : public LinearSolver {
 public:
  PetscConjugateGradients(const PetscPreconditioner& preconditioner, int block)
      : preconditioner_(preconditioner), block_(block) {}

  void set_up(const SparseRows& A, const std::vector<double>& coordinates) override {
    ksp_ = conjugate_gradients();
    A_ = system_matrix(A, preconditioner_, block_, coordinates);
    check(KSPSetOperators(ksp_, A_, A_));
    check(KSPSetUp(ksp_));
  }

  void change(const SparseRows& A) override {
    PetscMatrix next = petsc_matrix(A, block_);
    check(KSPSetReusePreconditioner(ksp_, PETSC_TRUE));
    check(KSPSetOperators(ksp_, next, next));
    A_ = std::move(next);
  }

  int solve(const std::vector<double>& b, std::vector<double>& x, double reduction) override {
    const PetscVector r = petsc_vector(b), start = petsc_vector(x);
    PetscVector dx, Ax;
    check(VecDuplicate(r, dx.fresh()));
    check(VecDuplicate(r, Ax.fresh()));
    check(MatMult(A_, start, Ax));
    check(VecAXPY(r, -1, Ax));
    const int iterations = bench::solve(ksp_, r, dx, reduction);
    check(VecAXPY(dx, 1, start));
    x = values_of(dx);
    return iterations;
  }

 private:
  PetscPreconditioner preconditioner_;
  int block_;
  PetscMatrix A_;
  PetscLinear ksp_;
};

/// Reduced-space Newton on one level.
class NewtonLevel {
 public:
  NewtonLevel(const Instance& instance, std::size_t level, const PetscPreconditioner& preconditioner, double tolerance)
      : program_(bounded(instance.levels[level].problem)),
        residual_of_(program_),
        tolerance_(tolerance),
        A_(system_matrix(program_.A, preconditioner, instance.block, instance.levels[level].coordinates)),
        b_(petsc_vector(program_.b)),
        lower_(petsc_vector(program_.lower)),
        upper_(petsc_vector(program_.upper)) {
    check(SNESCreate(PETSC_COMM_SELF, snes_.fresh()));
    check(SNESSetType(snes_, SNESVINEWTONRSLS));
    check(VecDuplicate(b_, f_.fresh()));
    check(SNESSetFunction(snes_, f_, gradient, this));
    check(SNESSetJacobian(snes_, A_, A_, hessian, nullptr));
    check(SNESVISetVariableBounds(snes_, lower_, upper_));
    check(SNESSetTolerances(snes_, 1e-300, 1e-300, 0, 500, 1000000));
    check(SNESSetConvergenceTest(snes_, test, this, nullptr));
    KSP ksp = nullptr;
    check(SNESGetKSP(snes_, &ksp));
    check(KSPSetType(ksp, KSPCG));
    grid_ = precondition(ksp, preconditioner, instance, level, snes_);
    check(SNESSetFromOptions(snes_));
  }

  /// Newton steps.
  int solve(std::vector<double>& values) {
    const PetscVector x = petsc_vector(values);
    check(SNESSolve(snes_, nullptr, x));
    SNESConvergedReason why;
    PetscInt steps = 0;
    check(SNESGetConvergedReason(snes_, &why));
    check(SNESGetIterationNumber(snes_, &steps));
    if (why < 0) throw std::runtime_error(std::string("PETSc: ") + SNESConvergedReasons[why]);
    values = values_of(x);
    return steps;
  }

 private:
  static PetscErrorCode gradient(SNES, Vec x, Vec f, void* context) {
    const auto* self = static_cast<const NewtonLevel*>(context);
    PetscCall(MatMult(self->A_, x, f));
    return VecAXPY(f, -1, self->b_);
  }

  static PetscErrorCode hessian(SNES, Vec, Mat, Mat, void*) { return 0; }  // constant

  static PetscErrorCode test(SNES snes, PetscInt, PetscReal, PetscReal, PetscReal, SNESConvergedReason* why,
                             void* context) {
    const auto* self = static_cast<const NewtonLevel*>(context);
    Vec x = nullptr;
    const double* values = nullptr;
    PetscCall(SNESGetSolution(snes, &x));
    PetscCall(VecGetArrayRead(x, &values));
    const bool done = self->residual_of_(values) <= self->tolerance_;
    PetscCall(VecRestoreArrayRead(x, &values));
    *why = done ? SNES_CONVERGED_FNORM_RELATIVE : SNES_CONVERGED_ITERATING;
    return 0;
  }

  QuadraticProgram program_;
  NaturalResidual residual_of_;
  double tolerance_;
  PetscMatrix A_;
  PetscVector b_, lower_, upper_, f_;
  std::unique_ptr<GridMultigrid> grid_;
  PetscNewton snes_;
};

}  // namespace

Attempt petsc_newton(const Instance& instance, const PetscPreconditioner& preconditioner, bool nested,
                     double tolerance) {
  const PetscSession session(preconditioner.options + " -ksp_rtol 1e-3");
  Attempt out;
  const ProcessorTime time;
  const std::size_t finest = instance.levels.size() - 1;
  for (std::size_t k = nested ? 0 : finest; k <= finest; ++k) {
    const GridLevel& level = instance.levels[k];
    out.x = out.x.empty() ? bounded(level.problem).projected_zero() : start_from(level, out.x);
    out.iterations =
        NewtonLevel(instance, k, preconditioner, k == finest ? tolerance : std::max(tolerance, 1e-4)).solve(out.x);
  }
  out.seconds = time.elapsed();
  return out;
}

Attempt petsc_cg(const Instance& instance, const PetscPreconditioner& preconditioner, double tolerance) {
  const PetscSession session(preconditioner.options);
  Attempt out;
  const ProcessorTime time;
  const QuadraticProgram program = unbounded(instance);
  const std::size_t finest = instance.levels.size() - 1;
  const PetscMatrix A = system_matrix(program.A, preconditioner, instance.block, instance.levels.back().coordinates);
  const PetscLinear ksp = conjugate_gradients();
  const auto grid = precondition(ksp, preconditioner, instance, finest, nullptr);
  check(KSPSetOperators(ksp, A, A));
  const PetscVector b = petsc_vector(program.b);
  PetscVector x;
  check(VecDuplicate(b, x.fresh()));
  out.iterations = solve(ksp, b, x, tolerance);
  out.x = values_of(x);
  out.seconds = time.elapsed();
  return out;
}

namespace {

/// From zero; the preconditioner is set up.
Attempt iterate(KSP ksp, const LinearSystem& system, double setup, double reduction) {
  const ProcessorTime time;
  const PetscVector b = petsc_vector(system.b);
  PetscVector x;
  check(VecDuplicate(b, x.fresh()));
  const int iterations = solve(ksp, b, x, reduction);
  return {setup, iterations, {setup, time.elapsed()}};
}

PetscErrorCode apply_shell(PC shell, Vec r, Vec z) {
  const Preconditioner* apply = nullptr;
  const double* from = nullptr;
  double* to = nullptr;
  PetscCall(PCShellGetContext(shell, &apply));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArrayWrite(z, &to));
  (*apply)(from, to);
  PetscCall(VecRestoreArrayRead(r, &from));
  return VecRestoreArrayWrite(z, &to);
}

}  // namespace

Attempt petsc_setup(const LinearSystem& system, const PetscPreconditioner& preconditioner, double reduction) {
  const PetscSession session(preconditioner.options);
  const ProcessorTime time;
  const PetscMatrix A = system_matrix(system.A, preconditioner, system.block, system.coordinates);
  const PetscLinear ksp = conjugate_gradients();
  check(KSPSetOperators(ksp, A, A));
  check(KSPSetUp(ksp));
  return iterate(ksp, system, time.elapsed(), reduction);
}

Attempt petsc_setup(const LinearSystem& system, const std::function<Preconditioner()>& make, double reduction) {
  const PetscSession session("-pc_type shell");
  const ProcessorTime time;
  Preconditioner apply = make();
  const double setup = time.elapsed();
  const PetscMatrix A = petsc_matrix(system.A, system.block);
  const PetscLinear ksp = conjugate_gradients();
  PC shell = nullptr;
  check(KSPGetPC(ksp, &shell));
  check(PCShellSetContext(shell, &apply));
  check(PCShellSetApply(shell, apply_shell));
  check(KSPSetOperators(ksp, A, A));
  check(KSPSetUp(ksp));
  return iterate(ksp, system, setup, reduction);
}

Attempt petsc_active_set(const Instance& instance, const PetscPreconditioner& preconditioner,
                         const ActiveSetOptions& options, double tolerance) {
  const PetscSession session(preconditioner.options);
  return active_set(
      instance, [&] { return std::make_unique<PetscConjugateGradients>(preconditioner, instance.block); }, options,
      tolerance);
}

}  // namespace signorini::bench
