#include <amgcl/adapter/crs_tuple.hpp>
#include <amgcl/amg.hpp>
#include <amgcl/backend/builtin.hpp>
#include <amgcl/coarsening/smoothed_aggregation.hpp>
#include <amgcl/relaxation/spai0.hpp>
#include <amgcl/solver/cg.hpp>
#include <stdexcept>

#include "apps/bench/peers/accuracy.hpp"
#include "apps/bench/peers/linear_solver.hpp"

namespace signorini::bench {
namespace {

class Amgcl final : public LinearSolver {
  using Backend = amgcl::backend::builtin<double>;
  using Amg = amgcl::amg<Backend, amgcl::coarsening::smoothed_aggregation, amgcl::relaxation::spai0>;
  using Cg = amgcl::solver::cg<Backend>;

 public:
  explicit Amgcl(int block) : block_(block) {}

  void set_up(const SparseRows& A, const std::vector<double>&) override {
    Amg::params parameters;
    parameters.coarsening.aggr.block_size = static_cast<unsigned>(block_);
    change(A);
    amg_ = std::make_unique<Amg>(matrix_, parameters);
  }

  void change(const SparseRows& A) override {
    const auto n = static_cast<std::size_t>(A.rows);
    matrix_ = std::make_shared<Backend::matrix>(std::tie(n, A.row, A.column, A.value));
  }

  int solve(const std::vector<double>& b, std::vector<double>& x, double reduction) override {
    Cg::params parameters;
    parameters.tol = reduction;
    parameters.maxiter = 2000;
    std::vector<double> r(b.size()), dx(b.size(), 0.0);
    amgcl::backend::residual(b, *matrix_, x, r);
    const auto [iterations, error] = Cg(b.size(), parameters)(*matrix_, *amg_, r, dx);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
    if (!(error <= reduction)) throw std::runtime_error("AMGCL: no convergence");
    return static_cast<int>(iterations);
  }

 private:
  int block_;
  std::shared_ptr<Backend::matrix> matrix_;
  std::unique_ptr<Amg> amg_;
};

}  // namespace

std::unique_ptr<LinearSolver> amgcl_solver(int block) { return std::make_unique<Amgcl>(block); }

}  // namespace signorini::bench
