#include <Eigen/CholmodSupport>
#include <stdexcept>

#include "apps/bench/peers/linear_solver.hpp"

namespace signorini::bench {
namespace {

class Cholmod final : public LinearSolver {
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

 public:
  Cholmod() {
    factor_.cholmod().nmethods = 1;
    factor_.cholmod().method[0].ordering = CHOLMOD_METIS;
  }

  bool wants_fixed_pattern() const override { return true; }

  void set_up(const SparseRows& A, const std::vector<double>&) override { factorise(A); }
  void change(const SparseRows& A) override { factorise(A); }

  int solve(const std::vector<double>& b, std::vector<double>& x, double) override {
    const auto n = static_cast<Eigen::Index>(b.size());
    Eigen::Map<Eigen::VectorXd>(x.data(), n) = factor_.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
    return 1;
  }

 private:
  void factorise(const SparseRows& A) {
    const std::vector<int> row(A.row.begin(), A.row.end());
    // Symmetric: its rows are its columns.
    const Eigen::Map<const Matrix> matrix(A.rows, A.rows, row.back(), row.data(), A.column.data(), A.value.data());
    if (!analysed_) factor_.analyzePattern(matrix);
    analysed_ = true;
    factor_.factorize(matrix);
    if (factor_.info() != Eigen::Success) throw std::runtime_error("CHOLMOD's factorisation failed");
  }

  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> factor_;
  bool analysed_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> cholmod_solver() { return std::make_unique<Cholmod>(); }

}  // namespace signorini::bench
