#include "apps/bench/peers/petsc_objects.hpp"

namespace signorini::bench {
namespace {

PetscSet index_set(const std::vector<Index>& members) {
  PetscSet out;
  check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(members.size()), members.data(), PETSC_COPY_VALUES,
                        out.fresh()));
  return out;
}

std::vector<Index> all(std::size_t size) {
  std::vector<Index> out(size);
  for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<Index>(i);
  return out;
}

/// Of the unknowns of a level, those that Newton's method does not hold.
std::vector<Index> free_unknowns(SNES newton, std::size_t size) {
  IS inactive = nullptr;
  if (newton) check(SNESVIGetInactiveSet(newton, &inactive));
  if (!inactive) return all(size);
  PetscInt count = 0;
  const PetscInt* members = nullptr;
  check(ISGetLocalSize(inactive, &count));
  check(ISGetIndices(inactive, &members));
  std::vector<Index> out(members, members + count);
  check(ISRestoreIndices(inactive, &members));
  return out;
}

}  // namespace

GridMultigrid::GridMultigrid(const Instance& instance, std::size_t level) : instance_(instance), level_(level) {
  for (std::size_t k = 1; k <= level; ++k) interpolations_.push_back(petsc_matrix(instance.levels[k].interpolation));
}

void GridMultigrid::attach(KSP ksp, SNES newton) {
  newton_ = newton;
  PC shell = nullptr;
  check(KSPGetPC(ksp, &shell));
  check(PCSetType(shell, PCSHELL));
  check(PCShellSetContext(shell, this));
  check(PCShellSetSetUp(shell, set_up));
  check(PCShellSetApply(shell, apply));
}

PetscErrorCode GridMultigrid::set_up(PC shell) {
  GridMultigrid* self = nullptr;
  Mat A = nullptr;
  PetscCall(PCShellGetContext(shell, &self));
  PetscCall(PCGetOperators(shell, nullptr, &A));
  try {
    self->build(A);
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  return 0;
}

PetscErrorCode GridMultigrid::apply(PC shell, Vec r, Vec z) {
  GridMultigrid* self = nullptr;
  PetscCall(PCShellGetContext(shell, &self));
  return PCApply(self->multigrid_, r, z);
}

std::vector<Index> GridMultigrid::free_twins(std::size_t level, const std::vector<Index>& free) const {
  const GridLevel& fine = instance_.levels[level];
  std::vector<bool> is_free(fine.problem.b.size(), false);
  for (const Index i : free) is_free[static_cast<std::size_t>(i)] = true;
  std::vector<Index> out;
  for (std::size_t i = 0; i < fine.twin.size(); ++i)
    if (is_free[static_cast<std::size_t>(fine.twin[i])]) out.push_back(static_cast<Index>(i));
  return out;
}

void GridMultigrid::give_coarse_matrices() {
  for (std::size_t k = 0; k < level_; ++k) {
    KSP smoother = nullptr;
    check(PCMGGetSmoother(multigrid_, static_cast<PetscInt>(k), &smoother));
    const PetscMatrix A = petsc_matrix(instance_.levels[k].problem.A, instance_.block);
    check(KSPSetOperators(smoother, A, A));  // which keeps it
  }
}

void GridMultigrid::build(Mat A) {
  check(PCCreate(PETSC_COMM_SELF, multigrid_.fresh()));
  check(PCSetType(multigrid_, PCMG));
  check(PCMGSetLevels(multigrid_, static_cast<PetscInt>(level_ + 1), nullptr));
  check(PCMGSetGalerkin(multigrid_, newton_ ? PC_MG_GALERKIN_BOTH : PC_MG_GALERKIN_NONE));
  std::vector<Index> free = free_unknowns(newton_, instance_.levels[level_].problem.b.size());
  for (std::size_t k = level_; k > 0; --k) {
    std::vector<Index> coarse = free_twins(k, free);
    PetscMatrix P;
    check(
        MatCreateSubMatrix(interpolations_[k - 1], index_set(free), index_set(coarse), MAT_INITIAL_MATRIX, P.fresh()));
    check(PCMGSetInterpolation(multigrid_, static_cast<PetscInt>(k), P));
    free = std::move(coarse);
  }
  if (!newton_) give_coarse_matrices();
  check(PCSetOperators(multigrid_, A, A));
  check(PCSetFromOptions(multigrid_));
  check(PCSetUp(multigrid_));
}

std::unique_ptr<GridMultigrid> precondition(KSP ksp, const PetscPreconditioner& preconditioner,
                                            const Instance& instance, std::size_t level, SNES newton) {
  if (!preconditioner.grid || level == 0) return nullptr;
  auto grid = std::make_unique<GridMultigrid>(instance, level);
  grid->attach(ksp, newton);
  return grid;
}

}  // namespace signorini::bench
