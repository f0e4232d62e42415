#include "amg/linear/cholmod/umfpack.hpp"

#include <umfpack.h>

#include <new>

namespace signorini {

namespace {

// Rows are handed over as if they were columns: what is factorised is the transposed matrix.
class Umfpack final : public UnsymmetricSolver {
 public:
  Umfpack() {
    umfpack_dl_defaults(control_);
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;  // of the pattern
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;
  ~Umfpack() override {
    umfpack_dl_free_numeric(&numeric_);
    umfpack_dl_free_symbolic(&symbolic_);
  }

  void analyse(const std::vector<Offset>& start, const std::vector<Index>& column) override {
    start_.assign(start.begin(), start.end());
    column_.assign(column.begin(), column.end());
    umfpack_dl_free_symbolic(&symbolic_);
  }

  bool factorise(const std::vector<double>& value) override {
    value_ = value;
    umfpack_dl_free_numeric(&numeric_);
    if (!symbolic_)
      refuse_failure(umfpack_dl_symbolic(size(), size(), start_.data(), column_.data(), value_.data(), &symbolic_,
                                         control_, info_));
    const auto status =
        umfpack_dl_numeric(start_.data(), column_.data(), value_.data(), symbolic_, &numeric_, control_, info_);
    if (status == UMFPACK_WARNING_singular_matrix) return false;
    refuse_failure(status);
    return true;
  }

  void solve(std::vector<double>& x) override {
    const std::vector<double> b = x;
    refuse_failure(umfpack_dl_solve(UMFPACK_Aat, start_.data(), column_.data(), value_.data(), x.data(), b.data(),
                                    numeric_, control_, info_));
  }

 private:
  SuiteSparse_long size() const { return static_cast<SuiteSparse_long>(start_.size()) - 1; }

  // What is left is memory that is not there.
  static void refuse_failure(SuiteSparse_long status) {
    if (status < UMFPACK_OK) throw std::bad_alloc();
  }

  std::vector<SuiteSparse_long> start_, column_;
  std::vector<double> value_;
  double control_[UMFPACK_CONTROL] = {}, info_[UMFPACK_INFO] = {};
  void *symbolic_ = nullptr, *numeric_ = nullptr;
};

}  // namespace

std::unique_ptr<UnsymmetricSolver> new_umfpack() { return std::make_unique<Umfpack>(); }

}  // namespace signorini
