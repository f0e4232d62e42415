#include "driver/moved_problem.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace signorini {

template <int B>
MovedProblem<B>::MovedProblem(DiscreteProblem<B>& problem, std::vector<double> way, std::vector<double>& x)
    : problem_(problem), way_(std::move(way)), x_(x) {
  if (way_.empty()) return;
  Constraints<B>& c = problem.constraints;
  lower_ = c.lower;
  upper_ = c.upper;
  prescribed_work_ = problem.prescribed_work;
  problem.prescribed_work += std::inner_product(way_.begin(), way_.end(), problem.b.begin(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= way_[i];
  facet_ = c.facet;
  c.move(way_);
}

template <int B>
void MovedProblem<B>::back() {
  if (way_.empty()) return;
  Constraints<B>& c = problem_.constraints;
  std::swap(c.lower, lower_);
  std::swap(c.upper, upper_);
  std::swap(c.facet, facet_);
  problem_.prescribed_work = prescribed_work_;
  const std::vector<double> left = x_;
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += way_[i];
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
