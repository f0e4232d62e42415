#include "driver/levels/moved_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/solver/attainable.hpp"
#include "core/solver/following_load.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

constexpr double far_less = 1e-4;  // than the way: what a body deforms then may be near what rounding does

/// What is left of a value after a way; nothing where that is rounding.
class Rest {
 public:
  explicit Rest(const std::vector<double>& way)
      : rounding_(256 * std::numeric_limits<double>::epsilon() * max_norm(way)) {}  // the way is a least-squares fit
  double operator()(double value, double way) const { return std::abs(value - way) <= rounding_ ? 0 : value - way; }

 private:
  double rounding_;
};

/// Calls visit(i) for each component i that is prescribed.
template <int B, class Visit>
void for_each_prescribed(const DiscreteProblem<B>& problem, Visit&& visit) {
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (std::size_t k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) visit(p * B + k);
}

/// A load that follows the solution is withdrawn: of what hardly deforms it is rounding, and no load to compare with.
template <int B>
Balance forces(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  if (problem.following) problem.following->withdraw();
  return balance(problem, x, r);
}

/// Nothing but rounding loads or bounds what has not moved.
template <int B>
bool rests(const DiscreteProblem<B>& problem, const Rest& rest) {
  const Constraints<B>& c = problem.constraints;
  return std::ranges::all_of(problem.b, [](double v) { return v == 0; }) &&
         std::ranges::all_of(c.lower, [&](double v) { return rest(v, 0) <= 0; }) &&
         std::ranges::all_of(c.upper, [&](double v) { return rest(v, 0) >= 0; }) &&
         std::ranges::all_of(c.facet, [](const Facet<B>& f) { return f.lower <= 0 && f.upper >= 0; });
}

/// Whatever a start is there is rounding, too.
template <int B>
void stay(DiscreteProblem<B>& problem, std::vector<double>& x, std::vector<double>& pressure) {
  std::ranges::fill(x, 0.0);
  std::ranges::fill(pressure, 0.0);
  for (double& bound : problem.constraints.lower) bound = std::min(bound, 0.0);
  for (double& bound : problem.constraints.upper) bound = std::max(bound, 0.0);
}

}  // namespace

template <int B>
void place_loads(Discretization<B>& discretization) {
  DiscreteProblem<B>& problem = discretization.problem;
  problem.b = local_forces(problem, discretization.load);
  discretization.prescribed.take_load(problem.b);
  prescribe(problem, discretization.prescribed);
}

template <int B>
MovedProblem<B>::MovedProblem(Discretization<B>& discretization, std::vector<double> way,
                              const std::vector<double>& of_springs, std::vector<double>& x,
                              std::vector<double>& pressure)
    : discretization_(discretization), way_(std::move(way)), x_(x) {
  if (way_.empty()) return;
  DiscreteProblem<B>& problem = discretization.problem;
  for_each_prescribed(problem, [&](std::size_t i) { prescribed_.push_back(problem.start[i]); });
  lower_ = problem.constraints.lower;
  upper_ = problem.constraints.upper;
  if (!of_springs.empty()) load_ = discretization.load;
  const Rest rest(way_);
  for_each_prescribed(problem, [&](std::size_t i) { problem.start[i] = rest(problem.start[i], way_[i]); });
  facet_ = problem.constraints.facet;
  problem.constraints.move(way_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = rest(x[i], way_[i]);
  for (std::size_t k = 0; k < of_springs.size(); ++k) discretization.load[k] += of_springs[k];
  place_loads(discretization);
  if (rests(problem, rest)) stay(problem, x, pressure);
  const std::vector<double> moved = to_global(problem, way_);
  const std::vector<double>& before = of_springs.empty() ? discretization.load : load_;
  problem.prescribed_work += (dot(moved, before) + dot(moved, discretization.load)) / 2;  // springs are linear
}

template <int B>
double MovedProblem<B>::back() {
  if (way_.empty()) return 0;
  DiscreteProblem<B>& problem = discretization_.problem;
  const bool stiff = max_norm(x_) < far_less * max_norm(way_);
  const double acting = stiff ? forces(problem, x_).acting : 0;
  if (problem.following) problem.following->withdraw();
  Constraints<B>& c = problem.constraints;
  for_each_prescribed(problem,
                      [&, value = prescribed_.begin()](std::size_t i) mutable { problem.start[i] = *value++; });
  std::swap(c.lower, lower_);
  std::swap(c.upper, upper_);
  std::swap(c.facet, facet_);
  if (!load_.empty()) discretization_.load = std::move(load_);
  place_loads(discretization_);
  const std::vector<double> left = x_;
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += way_[i];
  for_each_prescribed(problem, [&](std::size_t i) { x_[i] = problem.start[i]; });
  for (Index slot = 0; slot < c.size(); ++slot) {
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k, i = Offset{c.vector[slot]} * B + k;
      x_[i] = left[i] <= lower_[at] ? c.lower[at] : left[i] >= upper_[at] ? c.upper[at] : x_[i];
    }
    c.project(slot, x_.data() + Offset{c.vector[slot]} * B);
  }
  return acting > 0 ? forces(problem, x_).rounding / acting : 0;
}

template void place_loads(Discretization<1>&);
template class MovedProblem<1>;
template void place_loads(Discretization<2>&);
template class MovedProblem<2>;
template void place_loads(Discretization<3>&);
template class MovedProblem<3>;

}  // namespace signorini
