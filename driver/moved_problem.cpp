#include "driver/moved_problem.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

template <int B>
void subtract_prescribed(const std::vector<double>& way, DiscreteProblem<B>& problem) {
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (std::size_t k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) problem.start[p * B + k] -= way[p * B + k];
}

/// The right-hand side of the prescribed values of now.
template <int B>
void prescribe_anew(Discretization<B>& discretization) {
  DiscreteProblem<B>& problem = discretization.problem;
  problem.b = discretization.load;
  rotate(problem.b, problem.frames);
  prescribe(problem, discretization.prescribed);
}

}  // namespace

template <int B>
MovedProblem<B>::MovedProblem(Discretization<B>& discretization, std::vector<double> way, std::vector<double>& x)
    : discretization_(discretization), way_(std::move(way)), x_(x) {
  if (way_.empty()) return;
  DiscreteProblem<B>& problem = discretization.problem;
  start_ = problem.start;
  lower_ = problem.constraints.lower;
  upper_ = problem.constraints.upper;
  subtract_prescribed(way_, problem);
  facet_ = problem.constraints.facet;
  problem.constraints.move(way_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= way_[i];
  prescribe_anew(discretization);
  const std::vector<double> moved = to_global(problem, way_);
  problem.prescribed_work +=
      std::inner_product(moved.begin(), moved.end(), discretization.load.begin(), 0.0);
}

template <int B>
void MovedProblem<B>::back() {
  if (way_.empty()) return;
  DiscreteProblem<B>& problem = discretization_.problem;
  Constraints<B>& c = problem.constraints;
  std::swap(problem.start, start_);
  std::swap(c.lower, lower_);
  std::swap(c.upper, upper_);
  std::swap(c.facet, facet_);
  prescribe_anew(discretization_);
  const std::vector<double> left = x_;
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += way_[i];
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (std::size_t k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) x_[p * B + k] = problem.start[p * B + k];
  for (Index slot = 0; slot < c.size(); ++slot) {
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k, i = Offset{c.vector[slot]} * B + k;
      x_[i] = left[i] <= lower_[at] ? c.lower[at] : left[i] >= upper_[at] ? c.upper[at] : x_[i];
    }
    c.project(slot, x_.data() + Offset{c.vector[slot]} * B);
  }
}

template class MovedProblem<1>;
template class MovedProblem<2>;
template class MovedProblem<3>;

}  // namespace signorini
