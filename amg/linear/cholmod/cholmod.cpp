#include <cholmod.h>
#include <sys/mman.h>

#include <algorithm>
#include <new>

#include "amg/linear/cholmod/umfpack.hpp"
#include "amg/linear/cholmod_solver.hpp"

namespace signorini {

namespace {

// Pivots where the diagonal is 1, of a matrix that is singular but for rounding.
constexpr double no_pivot = 1e-11;

class Cholmod final : public LinearSolver {
 public:
  explicit Cholmod(int supernodal = CHOLMOD_AUTO) {
    cholmod_l_start(&common_);
    common_.supernodal = supernodal;
    common_.print = 0;
    common_.final_ll = true;
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  ~Cholmod() override {
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }

  void analyse(const std::vector<Offset>& start, const std::vector<Index>& row) override {
    start_.assign(start.begin(), start.end());
    row_.assign(row.begin(), row.end());
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_sparse A = matrix(nullptr);
    factor_ = cholmod_l_analyze(&A, &common_);
    refuse_failure();
  }

  bool factorise(const std::vector<double>& value, const std::vector<double>&) override {
    cholmod_sparse A = matrix(value.data());
    cholmod_l_factorize(&A, factor_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF) return false;
    refuse_failure();
    return size() == 0 || cholmod_l_rcond(factor_, &common_) > no_pivot;  // squared least over largest of L's diagonal
  }

  bool solve(std::vector<double>& x) override {
    if (x.empty()) return true;
    cholmod_dense b{};
    b.nrow = b.d = b.nzmax = x.size();
    b.ncol = 1;
    b.x = x.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, factor_, &b, &common_);
    refuse_failure();
    std::copy_n(static_cast<const double*>(solution->x), x.size(), x.begin());
    cholmod_l_free_dense(&solution, &common_);
    return true;
  }

 private:
  std::size_t size() const { return start_.size() - 1; }

  cholmod_sparse matrix(const double* value) {
    cholmod_sparse A{};
    A.nrow = A.ncol = size();
    A.nzmax = row_.size();
    A.p = start_.data();
    A.i = row_.data();
    A.x = const_cast<double*>(value);
    A.stype = -1;
    A.itype = CHOLMOD_LONG;
    A.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = true;
    return A;
  }

  // What is left is memory that is not there.
  void refuse_failure() const {
    if (common_.status < CHOLMOD_OK) throw std::bad_alloc();
  }

  std::vector<SuiteSparse_long> start_, row_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

/// OpenBLAS takes its working memory with its first call, and where there is none asks for it for ever. So that call
/// comes here, once as much is known to be free; later ones have the same memory.
/// @throws std::bad_alloc
bool take_working_memory() {
  constexpr std::size_t bytes = std::size_t{160} << 20;  // OpenBLAS 0.3 maps 128 MB on x86-64, and a little
  void* const free = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (free == MAP_FAILED) throw std::bad_alloc();
  munmap(free, bytes);
  Cholmod blas(CHOLMOD_SUPERNODAL);
  blas.analyse({0, 2, 3}, {0, 1, 1});
  blas.factorise({2, -1, 2}, {});
  return true;
}

}  // namespace

}  // namespace signorini

extern "C" __attribute__((visibility("default"))) signorini::LinearSolver* signorini_linear_solver() {
  [[maybe_unused]] static const bool can_work = signorini::take_working_memory();
  return new signorini::Cholmod;
}

extern "C" __attribute__((visibility("default"))) signorini::UnsymmetricSolver* signorini_unsymmetric_solver() {
  [[maybe_unused]] static const bool can_work = signorini::take_working_memory();
  return signorini::new_umfpack().release();
}
