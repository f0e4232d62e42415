#include "amg/nested_start.hpp"

#include "amg/masked_cg.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/fem/nested.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

template <int B>
void inherit_bounds(const DiscreteProblem<B>& fine, const std::vector<Index>& twin, Constraints<B>& coarse) {
  const Constraints<B>& c = fine.constraints;
  coarse.slot.assign(twin.size(), -1);
  for (std::size_t q = 0; q < twin.size(); ++q) {
    const Index slot = twin[q] < 0 || c.slot.empty() ? -1 : c.slot[twin[q]];
    if (slot < 0) continue;
    coarse.slot[q] = coarse.size();
    coarse.vector.push_back(static_cast<Index>(q));
    const auto from = Offset{slot} * B;
    coarse.lower.insert(coarse.lower.end(), c.lower.begin() + from, c.lower.begin() + from + B);
    coarse.upper.insert(coarse.upper.end(), c.upper.begin() + from, c.upper.begin() + from + B);
  }
}

/// Coarse vectors are in the order of their twins: runs of one obstacle stay runs.
template <int B>
std::vector<Segment<B>> inherit_obstacles(const DiscreteProblem<B>& fine, const std::vector<Index>& twin) {
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

/// Forces on the free components, those of prescribed values included.
template <int B>
std::vector<double> free_forces(const DiscreteProblem<B>& problem) {
  std::vector<double> r = problem.b;
  for (std::size_t k = 0; k < r.size(); ++k)
    if (problem.fixed[k / B] >> (k % B) & 1u) r[k] = 0;
  return r;
}

/// Relaxes the vectors between the twins while these rest. Interpolation knows no forces, and next to prescribed
/// values, which are forces here, nothing else gives the solution. Blocks are interpolated by weights that sum to one
/// there too, and this would make their corrections worse.
template <int B>
void relax_between_twins(const DiscreteProblem<B>& problem, const std::vector<Index>& twin,
                         const std::vector<double>& forces, std::vector<double>& x) {
  if (B > 1) return;
  std::vector<Flags> resting = problem.fixed;
  for (const Index p : twin)
    if (p >= 0) resting[p] = (1u << B) - 1;
  symmetric_gauss_seidel<B>(problem.A, resting, forces, x);
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
  inherit_bounds(problem, twin, out.constraints);
  out.segments = inherit_obstacles(problem, twin);
  return out;
}

/// The start that a coarser level gave, where it is better than none: a body that a coarser level hardly holds may have
/// been carried away there. What is merely rough is smoothed.
template <int B>
std::vector<double> better_start(const DiscreteProblem<B>& problem, std::vector<double> x) {
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
  return problem.start;
}

}  // namespace

template <int B>
std::vector<double> nested_start(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                 const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  if (prolongations.empty()) return problem.start;
  const std::size_t below = prolongations.size() - 1;
  const Prolongation& P = prolongations[below];
  try {
    const auto transfer = registry.create<Transfer<B>>("transfer", options.transfer);
    const std::vector<Index> twin = P.twins();
    const std::vector<double> forces = free_forces(problem);
    std::vector<double> base(forces.size(), 0.0);
    relax_between_twins(problem, twin, forces, base);
    const DiscreteProblem<B> coarse = coarse_problem(problem, P, twin, *transfer, forces, base);
    auto x = nested_start(coarse, prolongations.first(below), options, registry, monitor);
    const Summary summary =
        solve(coarse, prolongations.first(below), x, for_a_start<B>(options, below > 0), registry, monitor);
    if (summary.outcome == Outcome::unbounded) return problem.start;
    x = interpolate(coarse, x, P, problem);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += base[k];
    relax_between_twins(problem, twin, forces, x);
    return better_start(problem, std::move(x));
  } catch (const Error& error) {
    // What fails on a coarse level may well hold on the finest one, which alone decides.
    if (error.status() == Exit::interrupted) throw;
    return problem.start;
  }
}

template std::vector<double> nested_start(const DiscreteProblem<1>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&);
template std::vector<double> nested_start(const DiscreteProblem<2>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&);
template std::vector<double> nested_start(const DiscreteProblem<3>&, std::span<const Prolongation>,
                                          const SolverOptions&, const Registry&, const Monitor&);

}  // namespace signorini
