#include "apps/bench/peers/petsc_objects.hpp"

#include <algorithm>
#include <stdexcept>

namespace signorini::bench {

void check(PetscErrorCode status) {
  if (status == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(status, &text, nullptr);
  throw std::runtime_error(std::string("PETSc: ") + (text ? text : "error"));
}

PetscSession::PetscSession(const std::string& options) {
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr));
  check(PetscOptionsInsertString(nullptr, options.c_str()));
}

PetscSession::~PetscSession() { PetscFinalize(); }

PetscMatrix petsc_matrix(const SparseRows& A, int block) {
  const std::vector<PetscInt> row(A.row.begin(), A.row.end());
  PetscMatrix out;
  check(MatCreate(PETSC_COMM_SELF, out.fresh()));
  check(MatSetSizes(out, A.rows, A.columns, A.rows, A.columns));
  check(MatSetType(out, MATSEQAIJ));
  check(MatSetBlockSize(out, block));
  check(MatSeqAIJSetPreallocationCSR(out, row.data(), A.column.data(), A.value.data()));
  return out;
}

PetscVector petsc_vector(std::span<const double> values) {
  PetscVector out;
  check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(values.size()), out.fresh()));
  double* to = nullptr;
  check(VecGetArrayWrite(out, &to));
  // PETSc knows bounds of 1e20 and more as infinite.
  std::transform(values.begin(), values.end(), to,
                 [](double v) { return std::clamp<double>(v, PETSC_NINFINITY, PETSC_INFINITY); });
  check(VecRestoreArrayWrite(out, &to));
  return out;
}

std::vector<double> values_of(Vec v) {
  PetscInt size = 0;
  const double* from = nullptr;
  check(VecGetSize(v, &size));
  check(VecGetArrayRead(v, &from));
  std::vector<double> out(from, from + size);
  check(VecRestoreArrayRead(v, &from));
  return out;
}

void set_rigid_modes(Mat A, const std::vector<double>& coordinates) {
  const PetscVector points = petsc_vector(coordinates);
  check(VecSetBlockSize(points, 3));
  MatNullSpace modes = nullptr;
  check(MatNullSpaceCreateRigidBody(points, &modes));
  check(MatSetNearNullSpace(A, modes));
  check(MatNullSpaceDestroy(&modes));
}

}  // namespace signorini::bench
