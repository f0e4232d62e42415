#include "amg/black_box/nested_start.hpp"

#include <deque>
#include <optional>
#include <utility>

#include "core/algebra/energy_along.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/interpolate.hpp"
#include "core/solver/masked_cg.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/smooth_interpolation.hpp"
#include "core/solver/sticking.hpp"
#include "core/solver/weights.hpp"
#include "methods/near_start.hpp"
#include "methods/nested_iteration.hpp"

namespace signorini {

namespace {

/// Appends what `from` has at a slot, `width` numbers, where it has anything.
template <class T>
void inherit(const std::vector<T>& from, Index slot, int width, std::vector<T>& to) {
  if (from.empty()) return;
  const auto first = from.begin() + Offset{slot} * width;
  to.insert(to.end(), first, first + width);
}

template <int B>
void inherit_constraints(const DiscreteProblem<B>& fine, const std::vector<Index>& twin,
                         const std::vector<double>& base, Constraints<B>& coarse) {
  const Constraints<B>& c = fine.constraints;
  coarse.slot.assign(twin.size(), -1);
  coarse.width = c.width;
  for (std::size_t q = 0; q < twin.size(); ++q) {
    const Index slot = twin[q] < 0 || c.slot.empty() ? -1 : c.slot[twin[q]];
    if (slot < 0) continue;
    coarse.slot[q] = coarse.size();
    coarse.vector.push_back(static_cast<Index>(q));
    inherit(c.lower, slot, B, coarse.lower);
    inherit(c.upper, slot, B, coarse.upper);
    inherit(c.data, slot, c.width, coarse.data);
    inherit(c.before, slot, c.width, coarse.before);
    inherit(c.last, slot, B, coarse.last);
    inherit(c.tangential, slot, 1, coarse.tangential);
    for (int k = 0; k < B; ++k) {
      const double done = base[Offset{twin[q]} * B + k];
      coarse.lower[coarse.lower.size() - B + k] -= done;
      coarse.upper[coarse.upper.size() - B + k] -= done;
    }
  }
}

/// Coarse vectors are in the order of their twins: runs of one obstacle stay runs.
template <int B>
std::vector<Segment<B>> inherited_segments(const DiscreteProblem<B>& fine, const std::vector<Index>& twin) {
  std::vector<Segment<B>> out;
  Index first = 0;
  const auto end = static_cast<Index>(twin.size());
  for (const Segment<B>& s : fine.segments) {
    Index last = first;
    while (last < end && twin[last] < s.last) ++last;
    if (last > first) out.push_back({first, last, s.obstacle});
    first = last;
  }
  if (!out.empty()) out.back().last = end;
  return out;
}

/// For how many of the finer level's slots a vector of the coarser one stands: the sum of its weights there.
template <int B>
std::vector<double> slots_per_vector(const DiscreteProblem<B>& fine, const Prolongation& P) {
  std::vector<double> out(P.coarse, 0.0);
  weights::with<B>(P, [&](const auto& weight) {
    for (const Index p : fine.constraints.vector)
      for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) out[P.column[k]] += weight(k).mean();
  });
  return out;
}

/// Makes the functionals that were inherited those of the coarser level's vectors.
/// @return false: one of them does not say what it is there
template <int B>
bool scale_functionals(const std::vector<double>& ratio, const std::vector<Segment<B>>& segments, Constraints<B>& c) {
  for (const Segment<B>& s : segments) {
    if (!s.obstacle->functional()) continue;
    const Scaling* scaling = s.obstacle->scaling();
    if (!scaling) return false;
    const auto [from, to] = slots_between(c, s.first, s.last);
    for (Index slot = from; slot < to; ++slot)
      for (std::vector<double>* numbers : {&c.data, &c.before})
        scaling->scale(ratio[c.vector[slot]], numbers->data() + Offset{slot} * c.width);
  }
  return true;
}

/// Obstacles as if they were assembled on the coarser level. Where a functional does not scale, bounds alone are there.
template <int B>
void inherit_obstacles(const DiscreteProblem<B>& fine, const Prolongation& P, const std::vector<Index>& twin,
                       const std::vector<double>& base, DiscreteProblem<B>& coarse) {
  inherit_constraints(fine, twin, base, coarse.constraints);
  std::vector<Segment<B>> segments = inherited_segments(fine, twin);
  if (!has_functional(segments) || scale_functionals(slots_per_vector(fine, P), segments, coarse.constraints))
    coarse.segments = std::move(segments);
}

/// Forces on the free components, those of prescribed values included.
template <int B>
std::vector<double> free_forces(const DiscreteProblem<B>& problem) {
  std::vector<double> r = problem.b;
  for (std::size_t k = 0; k < r.size(); ++k)
    if (problem.fixed[k / B] >> (k % B) & 1u) r[k] = 0;
  return r;
}

/// A sweep to either side.
template <int B>
void sweep(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  Level<B> level = finest_level(problem);
  level.x = x.data();
  level.sweep(Order::forward);
  level.sweep(Order::backward);
}

/// Relaxes the vectors between the twins while these rest. Interpolation knows no forces, and next to prescribed
/// values, which are forces here, nothing else gives the solution. Blocks are interpolated by weights that sum to one
/// there too, and this would make their corrections worse. What is smooth would get kinks at the twins.
template <int B>
void relax_between_twins(const DiscreteProblem<B>& problem, const std::vector<Index>& twin,
                         const std::vector<double>& forces, std::vector<double>& x) {
  if (B > 1) return;
  std::vector<Flags> resting = problem.fixed;
  for (const Index p : twin)
    if (p >= 0) resting[p] = (1u << B) - 1;
  symmetric_gauss_seidel<B>(problem.A, resting, forces, x);
}

/// What sweeps make of the start. Smooth interpolation knows nothing of forces that are rough, such as pairs of
/// opposite ones at neighbours: the bending that these cause is left to the coarser level once sweeps have met them.
template <int B>
std::vector<double> relaxed_start(const DiscreteProblem<B>& problem) {
  constexpr int sweeps = 6;
  std::vector<double> x = problem.start;
  make_admissible(problem, x);
  for (int k = 0; k < sweeps; ++k) sweep(problem, x);
  apply_mask<B>(problem.fixed, x);
  return x;
}

/// Smooths a start of a problem with friction while nothing slips. The bounds of friction come from the forces on it,
/// and those that interpolation leaves would let everything go.
template <int B>
void settle_beneath_friction(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  if (!has_functional(problem.segments)) return;
  constexpr int sweeps = 2;
  make_admissible(problem, x);
  Level<B> level = finest_level(problem);
  Constraints<B>& c = level.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if (c.tangential[slot] >> k & 1u)
        c.lower[Offset{slot} * B + k] = c.upper[Offset{slot} * B + k] = x[Offset{c.vector[slot]} * B + k];
  level.x = x.data();
  for (int k = 0; k < sweeps; ++k) {
    level.sweep(Order::forward);
    level.sweep(Order::backward);
  }
}

/// @param forces on the free components
/// @param base what coarse corrections are added to
template <int B>
DiscreteProblem<B> coarse_problem(const DiscreteProblem<B>& problem, const Prolongation& P,
                                  const std::vector<Index>& twin, Transfer<B>& transfer,
                                  const std::vector<double>& forces, const std::vector<double>& base) {
  Level<B> fine = finest_level(problem), coarse;
  if (!problem.galerkin.empty()) coarse.galerkin = &problem.galerkin.back();
  transfer.prepare(fine, P, true, coarse);
  fine.clear_phases();
  coarse.clear_phases();
  transfer.assemble(fine, coarse);
  std::vector<double> r(forces.size());
  residual<B>(problem.A, base.data(), forces.data(), r.data());
  transfer.begin_restriction(coarse);
  transfer.restrict_residual(fine, 0, fine.vectors, r.data(), coarse);
  transfer.end_restriction(coarse);

  DiscreteProblem<B> out;
  out.A = std::move(coarse.own_matrix);
  if (coarse.galerkin) out.galerkin = problem.galerkin.first(problem.galerkin.size() - 1);
  out.b = std::move(coarse.own_b);
  out.fixed = std::move(coarse.off);
  out.start.assign(out.b.size(), 0.0);
  for (std::size_t k = 0; k < out.b.size(); ++k)
    if (const Index p = twin[k / B]; out.fixed[k / B] >> (k % B) & 1u)
      out.b[k] = out.start[k] = p < 0 ? 0 : problem.start[Offset{p} * B + k % B];
  out.frames = std::move(coarse.frames);
  inherit_obstacles(problem, P, twin, base, out);
  return out;
}

/// On each coarser level of smooth interpolation: contact grows and shrinks there, which takes many more cycles on
/// finer ones. Near its edge a plate leaves an obstacle by the cube of the distance, so that small errors move the edge
/// far: there levels are solved as accurately as the finest one.
constexpr int cycles_on_smooth_levels = 20;

/// The problem on the next coarser level than `fine`, to which it refers.
template <int B>
struct Coarser {
  const DiscreteProblem<B>& fine;
  const Prolongation& P;
  std::vector<Index> twin = P.twins();
  const bool smooth = B == 1 && is_smooth(P);
  std::vector<double> forces, base;  // on the free components of the finer level; what corrections are added to
  DiscreteProblem<B> problem;

  Coarser(const DiscreteProblem<B>& fine_problem, const Prolongation& prolongation, Transfer<B>& transfer)
      : fine(fine_problem), P(prolongation), forces(free_forces(fine)), base(forces.size(), 0.0) {
    if (smooth && !has_functional(fine.segments)) base = relaxed_start(fine);
    if (!smooth) relax_between_twins(fine, twin, forces, base);
    problem = coarse_problem(fine, P, twin, transfer, forces, base);
  }

  /// What a solution x here is on the finer level.
  std::vector<double> start_above(const std::vector<double>& x) const {
    std::vector<double> out = interpolate(problem, x, P, fine);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += base[k];
    if (!smooth) relax_between_twins(fine, twin, forces, out);
    stick_between(problem, x, P, fine, out);
    settle_beneath_friction(fine, out);
    return out;
  }
};

/// The start that a coarser level gave, where it is better than none: a body that a coarser level hardly holds may have
/// been carried away there. What is merely rough is smoothed. Nothing where it is worse.
template <int B>
std::optional<std::vector<double>> better_start(const DiscreteProblem<B>& problem, std::vector<double> x) {
  std::vector<double> none = problem.start, admissible = x;
  make_admissible(problem, none);
  make_admissible(problem, admissible);
  if (lowers(problem, admissible, none)) return x;
  Level<B> level = finest_level(problem);
  level.x = admissible.data();
  for (int sweep = 0; sweep < 3; ++sweep) {
    level.sweep(Order::forward);
    level.sweep(Order::backward);
    if (lowers(problem, admissible, none)) return x;
  }
  return {};
}

/// Makes a problem that for the difference of its solution to x, and puts it back in the end.
template <int B>
class Difference {
 public:
  Difference(DiscreteProblem<B>& problem, const std::vector<double>& x)
      : problem_(problem),
        b_(problem.b),
        start_(problem.start),
        lower_(problem.constraints.lower),
        upper_(problem.constraints.upper) {
    residual<B>(problem.A, x.data(), b_.data(), problem.b.data());
    for (std::size_t k = 0; k < x.size(); ++k)
      if (problem.fixed[k / B] >> (k % B) & 1u) problem.start[k] -= x[k];
    Constraints<B>& c = problem.constraints;
    for (std::size_t at = 0; at < c.lower.size(); ++at) {
      const double from = x[Offset{c.vector[at / B]} * B + at % B];
      c.lower[at] -= from;
      c.upper[at] -= from;
    }
  }
  Difference(const Difference&) = delete;
  Difference& operator=(const Difference&) = delete;
  ~Difference() {
    problem_.b.swap(b_);
    problem_.start.swap(start_);
    problem_.constraints.lower.swap(lower_);
    problem_.constraints.upper.swap(upper_);
  }

 private:
  DiscreteProblem<B>& problem_;
  std::vector<double> b_, start_, lower_, upper_;
};

/// What coarser levels cannot represent of x: d'Ad of the free components d of x less its interpolation from the twins.
template <int B>
double rough_energy(const DiscreteProblem<B>& problem, const Prolongation& P, const std::vector<double>& x) {
  std::vector<double> coarse(Offset{P.coarse} * B, 0.0), d = x;
  const std::vector<Index> twin = P.twins();
  for (Index q = 0; q < P.coarse; ++q)
    if (twin[q] >= 0) std::copy_n(x.begin() + Offset{twin[q]} * B, B, coarse.begin() + Offset{q} * B);
  weights::with<B>(P, [&](const auto& weight) {
    for (Index p = 0; p < P.fine(); ++p) {
      double value[B] = {};
      weights::interpolate<B>(P, weight, p, coarse.data(), value);
      for (int k = 0; k < B; ++k) d[Offset{p} * B + k] -= value[k];
    }
  });
  apply_mask<B>(problem.fixed, d);
  return energy_along(problem.A, d).of_matrix;
}

}  // namespace

template <int B>
std::vector<double> nested_start(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                 const SolverOptions& options, const Registry& registry, const Monitor& monitor,
                                 std::vector<Stage>* dropped) {
  const auto drop = [&](Stage stage) {
    if (dropped) dropped->push_back(std::move(stage));
  };
  const double begin = seconds();
  std::deque<Coarser<B>> levels;  // finest first; they refer to each other
  try {
    while (levels.size() < prolongations.size()) {
      const DiscreteProblem<B>& fine = levels.empty() ? problem : levels.back().problem;
      const Prolongation& P = prolongations[prolongations.size() - 1 - levels.size()];
      levels.emplace_back(fine, P, *registry.create<Transfer<B>>("transfer", options.transfer));
    }
  } catch (const Error&) {
    drop(failed_stage(automatic::attempt(automatic::Kind::nested_start).method, seconds() - begin, failure()));
  }
  const std::size_t left_out = prolongations.size() - levels.size();
  std::vector<double> x;
  bool ended = false;  // by the monitor: what there is is carried up, and the finest level says so
  const auto solve_level = [&](std::size_t k, const SolverOptions& own, bool started) -> std::string {
    const Coarser<B>& level = levels[levels.size() - 1 - k];
    if (!started) x = level.problem.start;
    if (ended) {
      x = level.start_above(x);
      return "";
    }
    SolverOptions mine = own;
    if (level.smooth) {
      mine.max_iterations = std::min(options.max_iterations, cycles_on_smooth_levels);
      mine.tolerance = options.tolerance;
    }
    const Summary summary = solve(level.problem, prolongations.first(left_out + k), x, mine, registry, monitor);
    ended = summary.outcome == Outcome::interrupted;
    if (summary.outcome == Outcome::unbounded) return summary.reason;
    auto better = better_start(level.fine, level.start_above(x));
    if (!better) return "its energy is above that of no start";
    x = std::move(*better);
    return "";
  };
  const auto failed = [&](std::size_t, Stage stage) { drop(std::move(stage)); };
  return nested_iteration<B>(levels.size(), options, solve_level, failed) ? x : problem.start;
}

template <int B>
std::vector<double> nested_start_from(const std::vector<double>& given, DiscreteProblem<B>& problem,
                                      std::span<const Prolongation> prolongations, const SolverOptions& options,
                                      const Registry& registry, const Monitor& monitor, std::vector<Stage>* dropped) {
  std::vector<double> x = given;
  if (prolongations.empty() || is_near(problem, prolongations, problem.galerkin, x)) return x;
  {
    const Difference<B> difference(problem, given);
    x = nested_start(problem, prolongations, options, registry, monitor, dropped);
  }
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += given[k];
  make_admissible(problem, x);
  sweep(problem, x);
  std::vector<double> correction = x;
  for (std::size_t k = 0; k < x.size(); ++k) correction[k] -= given[k];
  const Prolongation& P = prolongations.back();
  // What coarser levels get wrong of the correction is less than what they would of all.
  if (rough_energy(problem, P, correction) <= rough_energy(problem, P, x)) return x;
  std::vector<double> none = nested_start(problem, prolongations, options, registry, monitor, dropped);
  make_admissible(problem, none);
  return lowers(problem, x, none) ? x : none;
}

template std::vector<double> nested_start(const DiscreteProblem<1>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&, std::vector<Stage>*);
template std::vector<double> nested_start(const DiscreteProblem<2>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&, std::vector<Stage>*);
template std::vector<double> nested_start(const DiscreteProblem<3>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&, std::vector<Stage>*);

#define SIGNORINI_INSTANTIATE(B)                                                                                       \
  template std::vector<double> nested_start_from(const std::vector<double>&, DiscreteProblem<B>&,                      \
                                                 std::span<const Prolongation>, const SolverOptions&, const Registry&, \
                                                 const Monitor&, std::vector<Stage>*);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
