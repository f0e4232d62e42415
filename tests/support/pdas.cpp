#include "tests/support/pdas.hpp"

#include <Eigen/CholmodSupport>
#include <set>
#include <stdexcept>
#include <string>

namespace signorini::test {
namespace {

template <int B>
class Pdas {
 public:
  explicit Pdas(const DiscreteProblem<B>& problem)
      : A_(sparse(problem.A)), b_(vector(problem.b)), diagonal_(A_.diagonal()) {
    const auto n = b_.size();
    lower_ = Eigen::VectorXd::Constant(n, -infinity);
    upper_ = Eigen::VectorXd::Constant(n, infinity);
    prescribed_.assign(static_cast<std::size_t>(n), false);
    for (Eigen::Index i = 0; i < n; ++i)
      if (problem.fixed[static_cast<std::size_t>(i / B)] >> (i % B) & 1) {
        prescribed_[static_cast<std::size_t>(i)] = true;
        lower_[i] = upper_[i] = b_[i];
      }
    for (Index slot = 0; slot < problem.constraints.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        const Index i = problem.constraints.vector[slot] * B + k;
        if (prescribed_[static_cast<std::size_t>(i)]) continue;
        lower_[i] = problem.constraints.lower[static_cast<std::size_t>(slot) * B + k];
        upper_[i] = problem.constraints.upper[static_cast<std::size_t>(slot) * B + k];
      }
  }

  Reference solve() {
    result_.x = Eigen::VectorXd::Zero(b_.size()).cwiseMax(lower_).cwiseMin(upper_);
    result_.state = bound_everything();
    std::set<std::vector<signed char>> seen;
    while (result_.steps < 200 && !result_.cycled && !result_.converged) {
      result_.cycled = !seen.insert(result_.state).second;
      if (result_.cycled) break;
      ++result_.steps;
      solve_free();
      const auto next = next_state();
      result_.converged = next == result_.state || optimality() < 1e-13;
      if (!result_.converged) result_.state = next;
    }
    if (!result_.converged) projected_newton();
    result_.force = A_ * result_.x - b_;
    for (std::size_t i = 0; i < prescribed_.size(); ++i)
      if (prescribed_[i]) result_.state[i] = 2;
    return result_;
  }

  /// max |x - Proj(x - D^-1 (A x - b))| over max |x|, D the diagonal of A.
  double optimality() const {
    const Eigen::VectorXd step = result_.x - (A_ * result_.x - b_).cwiseQuotient(diagonal_);
    const double size = result_.x.cwiseAbs().maxCoeff();
    return (step.cwiseMax(lower_).cwiseMin(upper_) - result_.x).cwiseAbs().maxCoeff() / (size > 0 ? size : 1);
  }

 private:
  using State = std::vector<signed char>;

  State bound_everything() const {
    State state(prescribed_.size(), 0);
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (lower_[k] > -infinity)
        state[i] = -1;
      else if (upper_[k] < infinity)
        state[i] = 1;
    }
    return state;
  }

  // Complementarity written as max and min; the diagonal of A makes it free of units.
  State next_state() const {
    const Eigen::VectorXd force = A_ * result_.x - b_;
    State state(prescribed_.size(), 0);
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (lower_[k] == upper_[k] || force[k] + diagonal_[k] * (lower_[k] - result_.x[k]) > 0)
        state[i] = -1;
      else if (force[k] + diagonal_[k] * (upper_[k] - result_.x[k]) < 0)
        state[i] = 1;
    }
    return state;
  }

  // x at the bounds where active, and the minimiser of the energy elsewhere.
  void solve_free() {
    Eigen::VectorXd& x = result_.x;
    for (std::size_t i = 0; i < result_.state.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (result_.state[i] < 0) x[k] = lower_[k];
      if (result_.state[i] > 0) x[k] = upper_[k];
    }
    for (int refinement = 0; refinement < 3; ++refinement) x += newton_direction(result_.state);
  }

  // Solves A d = b - A x on the free unknowns. Where A is singular there, a proximal term keeps x near.
  Eigen::VectorXd newton_direction(const State& state) const {
    std::vector<Eigen::Index> number(state.size(), -1);
    Eigen::Index free = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      if (state[i] == 0) number[i] = free++;
    const Eigen::VectorXd r = b_ - A_ * result_.x;
    Eigen::VectorXd rhs(free), d = Eigen::VectorXd::Zero(r.size());
    if (free == 0) return d;
    for (std::size_t i = 0; i < state.size(); ++i)
      if (number[i] >= 0) rhs[number[i]] = r[static_cast<Eigen::Index>(i)];
    for (double proximal = 0; proximal<1; proximal = proximal> 0 ? 10 * proximal : 1e-10) {
      Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<double>> factor(restricted(number, free, proximal));
      if (factor.info() != Eigen::Success) continue;
      const Eigen::VectorXd y = factor.solve(rhs);
      if (!y.allFinite()) continue;
      for (std::size_t i = 0; i < state.size(); ++i)
        if (number[i] >= 0) d[static_cast<Eigen::Index>(i)] = y[number[i]];
      return d;
    }
    throw std::runtime_error("reference solver: the matrix is indefinite");
  }

  Eigen::SparseMatrix<double> restricted(const std::vector<Eigen::Index>& number, Eigen::Index free,
                                         double proximal) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < A_.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(A_, column); it; ++it) {
        const auto row = number[static_cast<std::size_t>(it.row())], q = number[static_cast<std::size_t>(column)];
        if (row < 0 || q < 0) continue;
        entries.emplace_back(row, q, it.value() * (row == q ? 1 + proximal : 1));
      }
    Eigen::SparseMatrix<double> S(free, free);
    S.setFromTriplets(entries.begin(), entries.end());
    return S;
  }

  double energy(const Eigen::VectorXd& x) const { return 0.5 * x.dot(A_ * x) - b_.dot(x); }

  void projected_newton() {
    Eigen::VectorXd& x = result_.x;
    x = x.cwiseMax(lower_).cwiseMin(upper_);
    for (int step = 0; step < 500 && !result_.converged; ++step, ++result_.steps) {
      result_.state = binding();
      const Eigen::VectorXd d = newton_direction(result_.state), start = x;
      const double before = energy(start);
      for (double length = 1; length > 1e-12; length /= 2) {
        x = (start + length * d).cwiseMax(lower_).cwiseMin(upper_);
        if (energy(x) <= before) break;
        x = start;
      }
      result_.converged = optimality() < 1e-13;
    }
    result_.state = binding();
  }

  // Unknowns that rest at a bound and are pressed against it.
  State binding() const {
    const Eigen::VectorXd force = A_ * result_.x - b_;
    State state(prescribed_.size(), 0);
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (result_.x[k] <= lower_[k] && (force[k] >= 0 || lower_[k] == upper_[k]))
        state[i] = -1;
      else if (result_.x[k] >= upper_[k] && force[k] <= 0)
        state[i] = 1;
    }
    return state;
  }

  Eigen::SparseMatrix<double> A_;
  Eigen::VectorXd b_, diagonal_, lower_, upper_;
  std::vector<bool> prescribed_;
  Reference result_;
};

}  // namespace

template <int B>
Reference reference(const DiscreteProblem<B>& problem) {
  Reference result = Pdas<B>(problem).solve();
  if (!result.converged)
    throw std::runtime_error("reference solver: no solution after " + std::to_string(result.steps) + " steps" +
                             (result.cycled ? ", the active sets cycled" : ""));
  return result;
}

template Reference reference<1>(const DiscreteProblem<1>&);
template Reference reference<2>(const DiscreteProblem<2>&);
template Reference reference<3>(const DiscreteProblem<3>&);

}  // namespace signorini::test
