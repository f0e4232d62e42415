#pragma once
#include <cmath>
#include <vector>

#include "core/algebra/products.hpp"
#include "core/solver/level.hpp"

/// The part of the energy that obstacles add: the sum of phi_p(x_p). See core/sdk/functional.hpp.
namespace signorini::functional {

/// phi(to) - phi(from) at the vectors first <= p < last of a level; 0 without functionals.
/// @param data of phi, in place of what is frozen; null: that
template <int B>
double change(const Level<B>& level, const double* from, const double* to, Index first, Index last,
              const double* data = nullptr) {
  if (!level.nonlinear) return 0;
  LevelView<B> view = level.view();
  if (data) view.data = data;
  double sum = 0;
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Functional<B>* phi = s.obstacle->functional()) sum += phi->change(view, begin, end, from, to);
  });
  return sum;
}

/// Derivative of phi at `at` along `step`, at the vectors first <= p < last of a level.
template <int B>
double slope(const Level<B>& level, const double* at, const double* step, Index first, Index last) {
  const LevelView<B> view = level.view();
  double sum = 0;
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Functional<B>* phi = s.obstacle->functional()) sum += phi->slope(view, begin, end, at, step);
  });
  return sum;
}

/// The same on the whole level.
template <int B>
double slope(const Level<B>& level, const double* at, const double* step) {
  return slope(level, at, step, 0, level.vectors);
}

/// A problem that is no level yet as its functionals see it.
template <int B>
LevelView<B> view(const DiscreteProblem<B>& problem) {
  const Constraints<B>& c = problem.constraints;
  LevelView<B> out{};
  out.vectors = problem.A.size();
  out.row = problem.A.row.data();
  out.column = problem.A.column.data();
  out.value = problem.A.value.data();
  out.slot = c.slot.data();
  out.constrained = c.vector.data();
  out.slots = c.size();
  out.lower = c.lower.data();
  out.upper = c.upper.data();
  out.data = c.data.data();
  out.width = c.width;
  out.before = c.before.data();
  out.last = c.last.data();
  out.tangential = c.tangential.data();
  out.facet_row = c.facet_row.empty() ? nullptr : c.facet_row.data();
  out.facet = c.facet.data();
  return out;
}

/// The same change for a problem.
template <int B>
double change(const DiscreteProblem<B>& problem, const double* from, const double* to, const double* data = nullptr) {
  LevelView<B> level = view(problem);
  if (data) level.data = data;
  double sum = 0;
  for (const Segment<B>& s : problem.segments)
    if (const Functional<B>* phi = s.obstacle->functional()) sum += phi->change(level, s.first, s.last, from, to);
  return sum;
}

/// The same slope for a problem.
template <int B>
double slope(const DiscreteProblem<B>& problem, const double* at, const double* step) {
  const LevelView<B> level = view(problem);
  double sum = 0;
  for (const Segment<B>& s : problem.segments)
    if (const Functional<B>* phi = s.obstacle->functional()) sum += phi->slope(level, s.first, s.last, at, step);
  return sum;
}

/// What phi is frozen with at x, as LevelView::data. Empty without functionals.
template <int B>
std::vector<double> data_at(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> data = problem.constraints.data;
  if (!follows_solution(problem.segments)) return data;
  LevelView<B> level = view(problem);
  level.x = const_cast<double*>(x.data());
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  for (const Segment<B>& s : problem.segments)
    if (const Renewal<B>* renewal = s.obstacle->renewal())
      renewal->renew(level, s.first, s.last, r.data(), data.data());
  return data;
}

/// Gradient of phi, frozen at x, at x where it is smooth, B per slot; empty without functionals.
template <int B>
std::vector<double> gradient(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  if (!has_functional(problem.segments)) return {};
  const std::vector<double> data = data_at(problem, x);
  LevelView<B> level = view(problem);
  level.data = data.data();
  level.x = const_cast<double*>(x.data());
  const auto slots = static_cast<std::size_t>(level.slots);
  std::vector<double> out(slots * B), hessian(slots * B * B), lower(slots * B, -infinity), upper(slots * B, infinity);
  std::vector<Flags> critical(slots);
  for (const Segment<B>& s : problem.segments)
    if (const Linearisation<B>* phi = s.obstacle->linearisation())
      phi->linearise(level, s.first, s.last, {out.data(), hessian.data(), lower.data(), upper.data(), critical.data()});
  return out;
}

/// Renews what is frozen in phi at the vectors first <= p < last from the iterate x and its residual r = b - A x.
/// @param data to be written, like Constraints::data
template <int B>
void renew(const Level<B>& level, const double* x, const double* r, Index first, Index last, double* data) {
  LevelView<B> view = level.view();
  view.x = const_cast<double*>(x);
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Renewal<B>* renewal = s.obstacle->renewal()) renewal->renew(view, begin, end, r, data);
  });
}

/// Lets friction hold all in the next cycle: what is frozen in phi, as it were if obstacles pressed beyond measure.
/// @param data of what is no friction, too; like Constraints::data
template <int B>
void press_beyond_measure(const Level<B>& level, const double* x, double* data) {
  constexpr double much = 1e6;  // over coefficients of friction
  double loads = 0;
  for (Index p = 0; p < level.vectors; ++p)
    for (int k = 0; k < B; ++k)
      if (!(level.off[p] >> k & 1u)) loads += std::abs(level.b[Offset{p} * B + k]);
  const Constraints<B>& c = level.constraints;
  std::vector<double> r(static_cast<std::size_t>(level.vectors) * B, -much * loads);
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{c.vector[slot]} * B + k;
      const double gap = x[at] - c.lower[Offset{slot} * B + k];
      if (gap > 0 && gap < infinity) r[at] -= level.A->diagonal(c.vector[slot])[k * (B + 1)] * gap;
    }
  LevelView<B> view = level.view();
  view.x = const_cast<double*>(x);
  level.for_each_segment(0, level.vectors, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (s.obstacle->renewal() && s.obstacle->friction()) s.obstacle->renewal()->renew(view, begin, end, r.data(), data);
  });
}

}  // namespace signorini::functional
