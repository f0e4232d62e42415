#include "driver/levels/level_start.hpp"

#include <algorithm>
#include <utility>

#include "core/solver/admissible.hpp"
#include "core/solver/interpolate.hpp"
#include "core/solver/least_energy.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/sticking.hpp"

namespace signorini {
namespace {

/// a + factor b, as far as b goes.
std::vector<double> plus(std::vector<double> a, double factor, const std::vector<double>& b) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) a[k] += factor * b[k];
  return a;
}

/// The last solution and the change that the coarser mesh saw.
template <int B>
std::vector<double> with_change(const DiscreteProblem<B>& problem, const std::vector<double>& last,
                                const CoarserStep<B>& coarser) {
  const std::vector<double> change = plus(coarser.x, -1, to_local(coarser.problem, coarser.before.u));
  return plus(last, 1, interpolate(coarser.problem, change, coarser.P, problem));
}

}  // namespace

template <int B>
std::vector<double> start_after(const DiscreteProblem<B>& problem, const LevelSolution<B>& before,
                                const CoarserStep<B>* coarser, std::vector<std::vector<double>> starts) {
  const std::vector<double> last = to_local(problem, before.u);
  starts.push_back(last);
  if (coarser && coarser->knows_change()) {
    std::vector<double> x = with_change(problem, last, *coarser);
    stick_between(coarser->problem, coarser->x, coarser->P, problem, x);
    starts.push_back(std::move(x));
  }
  for (std::vector<double>& x : starts) make_admissible(problem, x);
  return std::move(starts[least_energy(problem, starts)]);
}

template <int B>
void start_with_pressure(const DiscreteProblem<B>& problem, const LevelSolution<B>& before,
                         const CoarserStep<B>* coarser, const RefinedPressure& refined, std::vector<double>& x,
                         std::vector<double>& pressure) {
  const bool change = coarser && coarser->knows_change() && !before.pressure.empty();
  if (!change && coarser) return;
  x = to_local(problem, before.u);
  pressure = before.pressure;
  if (change) {
    x = with_change(problem, x, *coarser);
    pressure = plus(std::move(pressure), 1, refined(plus(coarser->pressure, -1, coarser->before.pressure)));
  }
  make_admissible(problem, x);
}

#define SIGNORINI_INSTANTIATE(B)                                                                                      \
  template std::vector<double> start_after(const DiscreteProblem<B>&, const LevelSolution<B>&, const CoarserStep<B>*, \
                                           std::vector<std::vector<double>>);                                         \
  template void start_with_pressure(const DiscreteProblem<B>&, const LevelSolution<B>&, const CoarserStep<B>*,        \
                                    const RefinedPressure&, std::vector<double>&, std::vector<double>&)
SIGNORINI_INSTANTIATE(1);
SIGNORINI_INSTANTIATE(2);
SIGNORINI_INSTANTIATE(3);
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
