#include "core/solver/active_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

template <int B>
ActiveSetIteration<B>::ActiveSetIteration(const DiscreteProblem<B>& problem, std::vector<double>& x,
                                          const SolverOptions& options, const Registry& registry,
                                          const std::string& linear)
    : Iteration<B>(problem, x, options),
      level_(finest_level(problem)),
      linear_(registry.create<LinearSolver>("linear", linear)) {
  find_pattern();
  linear_->analyse(start_, row_);
  value_.resize(row_.size());
  for (Index p = 0; p < level_.vectors; ++p)
    for (int k = 0; k < B; ++k) scale_.push_back(1 / std::sqrt(problem.A.diagonal(p)[k * B + k]));
}

// A and its pattern are symmetric: what is to the right of the diagonal in a row is what is below it in the column.
template <int B>
void ActiveSetIteration<B>::find_pattern() {
  const BlockMatrix<B>& A = this->problem_.A;
  start_.assign(1, 0);
  for (Index p = 0; p < A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      for (Offset m = A.row[p]; m < A.row[p + 1]; ++m)
        for (int i = A.column[m] == p ? k : 0; A.column[m] >= p && i < B; ++i) row_.push_back(A.column[m] * B + i);
      start_.push_back(static_cast<Offset>(row_.size()));
    }
}

// Calls visit(number in active_, unknown, lower bound, upper bound) for what is not prescribed.
template <int B>
template <class Visit>
void ActiveSetIteration<B>::visit_bounds(const Visit& visit) const {
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Index p = c.vector[slot];
      const auto at = static_cast<std::size_t>(slot) * B + static_cast<std::size_t>(k);
      if (!(level_.off[p] >> k & 1u)) visit(at, Offset{p} * B + k, c.lower[at], c.upper[at]);
    }
}

// Where the iterate would go beyond a bound if nothing but this component moved.
template <int B>
std::vector<signed char> ActiveSetIteration<B>::predicted() const {
  std::vector<signed char> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    const double target = y_[i] + r_y_[i] * scale_[i] * scale_[i];
    active[at] = lower == upper || target < lower ? -1 : target > upper ? 1 : 0;
  });
  return active;
}

template <int B>
std::vector<signed char> ActiveSetIteration<B>::at_bounds() const {
  std::vector<signed char> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    active[at] = y_[i] <= lower ? -1 : y_[i] >= upper ? 1 : 0;
  });
  return active;
}

template <int B>
std::vector<signed char> ActiveSetIteration<B>::all_bounded() const {
  std::vector<signed char> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset, double lower, double upper) {
    active[at] = lower > -infinity ? -1 : upper < infinity ? 1 : 0;
  });
  return active;
}

template <int B>
typename ActiveSetIteration<B>::Step ActiveSetIteration<B>::advance() {
  const double begin = seconds();
  ++steps_;
  this->x_before_ = this->x_;
  if (steps_ == 1) {
    y_ = this->x_;
    r_y_ = this->r_before_;
    active_ = at_bounds();
  }
  const std::vector<signed char> last = std::exchange(active_, predicted());
  const bool changed = steps_ == 1 || active_ != last;
  Step step;
  step.error = infinity;
  const bool solved = minimise(changed);
  if (!solved) {
    step.stuck = "the matrix is singular on the components that are not active: nothing holds the body there";
  } else {
    const std::string_view bytes(reinterpret_cast<const char*>(active_.data()), active_.size());
    const auto [found, fresh] = seen_.try_emplace(std::hash<std::string_view>()(bytes), steps_);
    if (changed && !fresh)
      step.stuck =
          fmt::format("the active sets of step {} came back in step {}: the method cycles", found->second, steps_);
  }
  this->sums_ = this->evaluate(this->x_, this->r_);
  this->refuse_nan(this->sums_.natural_residual);
  if (solved) step.error = std::sqrt(std::abs(this->sums_.correction));
  step.levels = {report(last)};
  step.levels.front().renewed = changed ? level_.vectors : 0;
  step.levels.front().seconds = seconds() - begin;
  return step;
}

// The start may be a body that touches nothing; with all bounds active there is something to hold it.
template <int B>
bool ActiveSetIteration<B>::minimise(bool changed) {
  if ((!changed || factorise()) && solve_free()) return true;
  if (steps_ > 1 || active_ == all_bounded()) return false;
  active_ = all_bounded();
  return factorise() && solve_free();
}

template <int B>
bool ActiveSetIteration<B>::factorise() {
  const BlockMatrix<B>& A = this->problem_.A;
  std::vector<char> held(scale_.size(), 0);
  visit_bounds([&](std::size_t at, Offset i, double, double) { held[i] = active_[at] != 0; });
  auto value = value_.begin();
  for (Index p = 0; p < A.size(); ++p)
    for (int k = 0; k < B; ++k)
      for (Offset m = A.row[p]; m < A.row[p + 1]; ++m)
        for (int i = A.column[m] == p ? k : 0; A.column[m] >= p && i < B; ++i) {
          const Offset row = Offset{p} * B + k, column = Offset{A.column[m]} * B + i;
          const bool coupled = !held[row] && !held[column];
          *value++ = row == column ? 1 : coupled ? A.at(m)[k * B + i] * scale_[row] * scale_[column] : 0;
        }
  return linear_->factorise(value_, scale_);
}

template <int B>
bool ActiveSetIteration<B>::solve_free() {
  const DiscreteProblem<B>& problem = this->problem_;
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    if (active_[at] != 0) y_[i] = active_[at] < 0 ? lower : upper;
  });
  residual<B>(problem.A, y_.data(), problem.b.data(), r_y_.data());
  visit_bounds([&](std::size_t at, Offset i, double, double) {
    if (active_[at] != 0) r_y_[i] = 0;
  });
  for (std::size_t i = 0; i < r_y_.size(); ++i) r_y_[i] *= scale_[i];
  if (!linear_->solve(r_y_)) return false;
  for (std::size_t i = 0; i < r_y_.size(); ++i) y_[i] += scale_[i] * r_y_[i];
  residual<B>(problem.A, y_.data(), problem.b.data(), r_y_.data());
  this->x_ = y_;
  make_admissible(this->problem_, this->x_);
  return true;
}

template <int B>
LevelReport ActiveSetIteration<B>::report(const std::vector<signed char>& last) const {
  LevelReport out;
  out.vectors = level_.vectors;
  for (Index slot = 0; slot < level_.constraints.size(); ++slot) {
    bool critical = false, changed = false;
    for (int k = 0; k < B; ++k) {
      const auto at = static_cast<std::size_t>(slot) * B + static_cast<std::size_t>(k);
      out.contact[static_cast<std::size_t>(k)] += active_[at] != 0;
      critical = critical || active_[at] != 0;
      changed = changed || active_[at] != last[at];
    }
    out.critical += critical;
    out.changed += changed;
  }
  return out;
}

template class ActiveSetIteration<1>;
template class ActiveSetIteration<2>;
template class ActiveSetIteration<3>;

}  // namespace signorini
