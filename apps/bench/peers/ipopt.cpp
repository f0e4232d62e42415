#include "apps/bench/peers/ipopt.hpp"

#include <mpi.h>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <stdexcept>

#include "apps/bench/peers/accuracy.hpp"
#include "apps/bench/processor_time.hpp"

namespace signorini::bench {
namespace {

using Ipopt::Number;

class BoxProgram final : public Ipopt::TNLP {
 public:
  explicit BoxProgram(const QuadraticProgram& program) : p_(program) {
    for_lower([this](Index, Index, double) { ++entries_; });
  }

  std::vector<double> x;

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = p_.A.rows;
    m = jacobian = 0;
    hessian = entries_;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index, Number*, Number*) override {
    constexpr double none = 2e19;  // beyond IPOPT's infinity
    for (Index i = 0; i < n; ++i) {
      lower[i] = std::max(p_.lower[i], -none);
      upper[i] = std::min(p_.upper[i], none);
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* start, bool, Number*, Number*, Index, bool, Number*) override {
    const auto zero = p_.projected_zero();
    std::copy(zero.begin(), zero.end(), start);
    return true;
  }

  bool eval_f(Index n, const Number* y, bool, Number& f) override {
    std::vector<double> Ay(p_.b.size());
    multiply(p_.A, y, Ay.data());
    f = 0;
    for (Index i = 0; i < n; ++i) f += y[i] * (0.5 * Ay[i] - p_.b[i]);
    return true;
  }

  bool eval_grad_f(Index n, const Number* y, bool, Number* gradient) override {
    multiply(p_.A, y, gradient);
    for (Index i = 0; i < n; ++i) gradient[i] -= p_.b[i];
    return true;
  }

  bool eval_g(Index, const Number*, bool, Index, Number*) override { return true; }
  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index*, Index*, Number*) override { return true; }

  bool eval_h(Index, const Number*, bool, Number factor, Index, const Number*, bool, Index, Index* row, Index* column,
              Number* value) override {
    Index at = 0;
    for_lower([&](Index i, Index j, double a) {
      if (value) {
        value[at] = factor * a;
      } else {
        row[at] = i;
        column[at] = j;
      }
      ++at;
    });
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* y, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    x.assign(y, y + n);
  }

 private:
  template <class Visit>
  void for_lower(Visit&& visit) const {
    for (Index i = 0; i < p_.A.rows; ++i)
      for (Offset k = p_.A.row[i]; k < p_.A.row[i + 1]; ++k)
        if (p_.A.column[k] <= i) visit(i, p_.A.column[k], p_.A.value[k]);
  }

  QuadraticProgram p_;
  Index entries_ = 0;
};

/// PETSc brings the MUMPS that calls MPI, and IPOPT's own one is not used where both are loaded.
class MpiSession {
 public:
  MpiSession() { MPI_Init(nullptr, nullptr); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession() { MPI_Finalize(); }
};

double mean_diagonal(const SparseRows& A) {
  double sum = 0;
  for (const double d : diagonal(A)) sum += d;
  return sum / A.rows;
}

}  // namespace

Attempt ipopt(const Instance& instance, double tolerance) {
  const MpiSession session;
  Attempt out;
  const ProcessorTime time;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  const auto options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetStringValue("hessian_constant", "yes");
  options->SetStringValue("linear_solver", "mumps");
  options->SetStringValue("mehrotra_algorithm", "yes");
  options->SetStringValue("nlp_scaling_method", "none");
  options->SetNumericValue("bound_relax_factor", 0);
  // Its dual residual is Ax - b, ours D^-1 (Ax - b).
  options->SetNumericValue("obj_scaling_factor", 1 / mean_diagonal(instance.finest().A));
  options->SetNumericValue("tol", tolerance);
  if (application->Initialize() != Ipopt::Solve_Succeeded) throw std::runtime_error("IPOPT refuses its options");
  const Ipopt::SmartPtr<BoxProgram> program = new BoxProgram(bounded(instance.finest()));
  application->OptimizeTNLP(Ipopt::GetRawPtr(program));
  if (program->x.empty()) throw std::runtime_error("IPOPT gives no solution");
  if (Ipopt::IsValid(application->Statistics())) out.iterations = application->Statistics()->IterationCount();
  out.x = program->x;
  out.seconds = time.elapsed();
  return out;
}

}  // namespace signorini::bench
