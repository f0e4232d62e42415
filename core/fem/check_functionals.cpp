#include "core/fem/check_functionals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/functional.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-9;  // of displacements and bounds, what x may be beyond these

template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// Asks the functionals of a problem at one vector of unknowns, node by node.
template <int D, int B>
class Check {
 public:
  Check(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
        const std::vector<double>& x)
      : nodes_(nodes),
        model_(model),
        acts_(discretization.functional),
        problem_(discretization.problem),
        x_(x),
        data_(functional::data_at(problem_, x)),
        view_(functional::view(problem_)) {
    view_.data = data_.data();
    view_.x = const_cast<double*>(x.data());  // for sweeps, which are not asked for
    for (const double value : x)
      if (std::isfinite(value)) largest_ = std::max(largest_, std::abs(value));
  }

  /// What x is at the nodes of functionals.
  void solution() const {
    each_slot([this](Index slot) {
      if (!all_finite(at(slot))) refuse(slot, "the local solver or the linearisation leads to", at(slot));
      if (is_beyond_bounds(slot))
        refuse(slot,
               fmt::format("with the bounds ({:.6g}) and ({:.6g}) the local solver leads to",
                           fmt::join(of_slot(slot, problem_.constraints.lower), ", "),
                           fmt::join(of_slot(slot, problem_.constraints.upper), ", ")),
               at(slot));
    });
  }

  /// What functionals say about x, which is finite there.
  void answers() {
    const std::vector<double> gradient = functional::gradient(problem_, x_), zero(x_.size());
    each_slot([&](Index slot) {
      const Index p = problem_.constraints.vector[slot];
      const Functional<B>& phi = *obstacle(slot).functional();
      const auto width = static_cast<std::size_t>(view_.width);
      expect_finite(slot, "what is renewed", std::span(data_).subspan(static_cast<std::size_t>(slot) * width, width));
      expect_finite(slot, "the gradient", of_slot(slot, gradient));
      expect_finite(slot, "the change", std::array{phi.change(view_, p, p + 1, zero.data(), x_.data())});
      expect_finite(slot, "the slope", std::array{phi.slope(view_, p, p + 1, x_.data(), x_.data())});
    });
  }

  /// How far the local solvers say that x is off.
  void local_solvers() {
    std::vector<double> r(x_.size());
    const std::vector<double> inverse(x_.size() * B);  // for nodes that nothing acts on
    residual<B>(problem_.A, x_.data(), problem_.b.data(), r.data());
    view_.inverse = inverse.data();
    each_slot([&](Index slot) {
      const Index p = problem_.constraints.vector[slot];
      expect_finite(slot, "the result of the local solver",
                    std::array{obstacle(slot).natural_residual(view_, p, p + 1, r.data())});
    });
  }

 private:
  template <class Use>
  void each_slot(const Use& use) const {
    for (std::size_t slot = 0; slot < acts_.size(); ++slot)
      if (acts_[slot] >= 0) use(static_cast<Index>(slot));
  }

  const Obstacle<B>& obstacle(Index slot) const { return *model_.obstacles[acts_[slot]].obstacle; }

  std::span<const double> at(Index slot) const {
    return std::span(x_).subspan(static_cast<std::size_t>(problem_.constraints.vector[slot]) * B, B);
  }
  static std::span<const double> of_slot(Index slot, const std::vector<double>& all) {
    return std::span(all).subspan(static_cast<std::size_t>(slot) * B, B);
  }

  bool is_beyond_bounds(Index slot) const {
    const auto lower = of_slot(slot, problem_.constraints.lower), upper = of_slot(slot, problem_.constraints.upper);
    for (int k = 0; k < B; ++k) {
      const double beyond = std::max(lower[k] - at(slot)[k], at(slot)[k] - upper[k]);
      const double bound = std::min(std::abs(lower[k]), std::abs(upper[k]));
      if (beyond > rounding * (largest_ + bound)) return true;
    }
    return false;
  }

  template <class Numbers>
  void expect_finite(Index slot, const char* what, const Numbers& found) const {
    if (!all_finite(found)) refuse(slot, fmt::format("at finite unknowns {} is", what), found);
  }

  template <class Numbers>
  [[noreturn]] void refuse(Index slot, const std::string& what, const Numbers& found) const {
    throw Error(Exit::plugin, fmt::format("{}: at ({:.6g}), in local coordinates, {} ({:.6g}): a fault of the plugin",
                                          model_.obstacles[acts_[slot]].origin,
                                          fmt::join(nodes_.at(problem_.constraints.vector[slot]), ", "), what,
                                          fmt::join(found, ", ")));
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const std::vector<Index>& acts_;  // per slot the obstacle whose functional does
  const DiscreteProblem<B>& problem_;
  const std::vector<double>& x_;
  std::vector<double> data_;  // what functionals are frozen with
  LevelView<B> view_;
  double largest_ = 0;
};

}  // namespace

template <int D, int B>
void check_functionals(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                       const std::vector<double>& x) {
  if (discretization.functional.empty()) return;
  Check<D, B> check(nodes, model, discretization, x);
  check.solution();
  if (all_finite(x)) check.answers();
}

template <int D, int B>
void blame_functionals(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                       std::vector<double> x) {
  if (discretization.functional.empty()) return;
  const DiscreteProblem<B>& problem = discretization.problem;
  for (double& value : x)
    if (!std::isfinite(value)) value = 0;
  make_admissible(problem, x);
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  if (!std::isfinite(dot(r, r)) || !std::isfinite(dot(x, x))) return;  // no finite question
  Check<D, B> check(nodes, model, discretization, x);
  check.answers();
  check.local_solvers();
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                 \
  template void check_functionals<D, B>(const Nodes<D>&, const Model<B>&, const Discretization<B>&, \
                                        const std::vector<double>&);                                \
  template void blame_functionals<D, B>(const Nodes<D>&, const Model<B>&, const Discretization<B>&, \
                                        std::vector<double>);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
