#pragma once
#include <petsc.h>

#include <span>
#include <utility>

#include "apps/bench/peers/petsc.hpp"

namespace signorini::bench {

/// Throws std::runtime_error with PETSc's message.
void check(PetscErrorCode status);

/// PETSc while it is needed; destroy all objects before.
class PetscSession {
 public:
  explicit PetscSession(const std::string& options);
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
  ~PetscSession();
};

/// Owns one PETSc object.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~PetscHandle() {
    if (object_) destroy(&object_);
  }
  operator Object() const { return object_; }  // NOLINT: stands for it in PETSc's calls
  /// To be filled by PETSc.
  Object* fresh() {
    if (object_) destroy(&object_);
    return &object_;
  }

 private:
  Object object_ = nullptr;
};

using PetscMatrix = PetscHandle<Mat, MatDestroy>;
using PetscVector = PetscHandle<Vec, VecDestroy>;
using PetscLinear = PetscHandle<KSP, KSPDestroy>;
using PetscNewton = PetscHandle<SNES, SNESDestroy>;
using PetscSet = PetscHandle<IS, ISDestroy>;
using PetscPc = PetscHandle<PC, PCDestroy>;

PetscMatrix petsc_matrix(const SparseRows& A, int block = 1);
PetscVector petsc_vector(std::span<const double> values);
std::vector<double> values_of(Vec v);
/// Rigid motions as near null space; coordinates three per vector.
void set_rigid_modes(Mat A, const std::vector<double>& coordinates);

/// Multigrid with the interpolations of an instance, on the unknowns that are free at the moment: those that Newton's
/// method holds at a bound leave their level, and their coarser twins with them. Built anew with each matrix.
/// Where nothing is held, the coarse matrices are those of the instance; of reduced matrices the products are computed.
class GridMultigrid {
 public:
  /// @param level the finest one here
  GridMultigrid(const Instance& instance, std::size_t level);

  /// Makes it the preconditioner of a solver; keep it as long as that.
  /// @param newton tells which unknowns are held; null: none
  void attach(KSP ksp, SNES newton);

 private:
  static PetscErrorCode set_up(PC shell);
  static PetscErrorCode apply(PC shell, Vec r, Vec z);
  void build(Mat A);
  void give_coarse_matrices();
  std::vector<Index> free_twins(std::size_t level, const std::vector<Index>& free) const;

  const Instance& instance_;
  std::size_t level_;
  SNES newton_ = nullptr;
  std::vector<PetscMatrix> interpolations_;
  PetscPc multigrid_;
};

/// Sets a preconditioner for a level of an instance; keep what is returned as long as the solver.
std::unique_ptr<GridMultigrid> precondition(KSP ksp, const PetscPreconditioner& preconditioner,
                                            const Instance& instance, std::size_t level, SNES newton);

}  // namespace signorini::bench
