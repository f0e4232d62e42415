#pragma once
#include <vector>

#include "core/solver/level.hpp"

/// The part of the energy that obstacles add: the sum of phi_p(x_p). See core/sdk/nonlinearity.hpp.
namespace signorini::functional {

/// phi(to) - phi(from) at the vectors first <= p < last of a level; 0 without functionals.
template <int B>
double change(const Level<B>& level, const double* from, const double* to, Index first, Index last) {
  if (!level.nonlinear) return 0;
  const LevelView<B> view = level.view();
  double sum = 0;
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Nonlinearity<B>* phi = s.obstacle->nonlinearity()) sum += phi->change(view, begin, end, from, to);
  });
  return sum;
}

/// Derivative of phi at `at` along `step`, on the whole level.
template <int B>
double slope(const Level<B>& level, const double* at, const double* step) {
  const LevelView<B> view = level.view();
  double sum = 0;
  level.for_each_segment(0, level.vectors, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Nonlinearity<B>* phi = s.obstacle->nonlinearity()) sum += phi->slope(view, begin, end, at, step);
  });
  return sum;
}

/// The same change for a problem that is no level yet.
template <int B>
double change(const DiscreteProblem<B>& problem, const double* from, const double* to) {
  const Constraints<B>& c = problem.constraints;
  LevelView<B> view{};
  view.vectors = problem.A.size();
  view.slot = c.slot.data();
  view.constrained = c.vector.data();
  view.slots = c.size();
  view.lower = c.lower.data();
  view.upper = c.upper.data();
  view.data = c.data.data();
  view.width = c.width;
  view.last = c.last.data();
  view.tangential = c.tangential.data();
  double sum = 0;
  for (const Segment<B>& s : problem.segments)
    if (const Nonlinearity<B>* phi = s.obstacle->nonlinearity()) sum += phi->change(view, s.first, s.last, from, to);
  return sum;
}

/// Renews what is frozen in phi at the vectors first <= p < last from the iterate x and its residual r = b - A x.
template <int B>
void renew(Level<B>& level, const double* x, const double* r, Index first, Index last) {
  LevelView<B> view = level.view();
  view.x = const_cast<double*>(x);
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    if (const Nonlinearity<B>* phi = s.obstacle->nonlinearity())
      phi->renew(view, begin, end, r, level.constraints.data.data());
  });
}

}  // namespace signorini::functional
