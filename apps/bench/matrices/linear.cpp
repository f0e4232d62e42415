#include "apps/bench/matrices/linear.hpp"

#include <cmath>

#include "amg/black_box/block_rows.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "amg/linear/algebraic_cycle.hpp"
#include "amg/registration.hpp"
#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solver/convergence.hpp"

namespace signorini::bench {
namespace {

// max over the vectors of ||A_pp^-1 r_p||
template <int B>
double natural_residual(const Level<B>& level, const std::vector<double>& r) {
  double largest = 0;
  for (Index p = 0; p < level.vectors; ++p) {
    double d[B];
    block::product<B>(level.inverse.data() + Offset{p} * B * B, r.data() + Offset{p} * B, d);
    largest = std::max(largest, block::norm<B>(d));
  }
  return largest;
}

}  // namespace

template <int B>
LinearSolve multigrid_cg(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                         const Registry& registry, double tolerance) {
  LinearSolve result;
  Stopwatch watch;
  DiscreteProblem<B> correction = problem;  // its right-hand side is the residual
  const auto n = problem.b.size();
  MonotoneMultigrid<B> multigrid(correction, prolongations, symmetric_cycle<B>(registry), {});
  std::vector<double> x = problem.start, r(n), z(n), p(n), Ap(n);
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  const double reference = natural_residual(multigrid.finest(), r);
  const auto precondition = [&] {
    std::copy(r.begin(), r.end(), correction.b.begin());
    std::fill(z.begin(), z.end(), 0.0);
    multigrid.cycle(z.data());
  };
  result.setup = watch.lap();
  precondition();
  double rz = dot(r, z);
  p = z;
  ErrorEstimate estimate;
  for (bool done = rz == 0; !done && result.iterations < 200; ++result.iterations) {
    product<B>(problem.A, p.data(), Ap.data());
    const double alpha = rz / dot(p, Ap);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * Ap[i];
    }
    estimate.add(0.5 * alpha * rz, std::sqrt(alpha * rz));
    result.residual = natural_residual(multigrid.finest(), r) / reference;
    result.algebraic_error = estimate.error() / std::sqrt(energy_norm_squared(problem, x, r));
    done = result.residual <= tolerance && result.algebraic_error <= tolerance;
    if (done) continue;
    precondition();
    const double next = dot(r, z);
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  result.solve = watch.lap();
  result.x = std::move(x);
  return result;
}

namespace {

template <int B>
double complexity(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels) {
  const auto finest = static_cast<double>(A.column.size());
  double all = finest;
  for (const GalerkinMatrix<B>& coarse : levels.matrices) all += static_cast<double>(coarse.A.column.size());
  return all / finest;
}

/// A matrix with its levels, and as yet no right-hand side.
template <int B>
struct AlgebraicProblem {
  const Registry registry = solver_components();
  DiscreteProblem<B> problem;
  AlgebraicLevels<B> levels;

  AlgebraicProblem(const SparseRows& A, Coarsening coarsening, const NearNullSpace& near_null,
                   const Aggregator& aggregator) {
    const auto n = static_cast<std::size_t>(A.rows);
    problem.A = block_matrix<B>(A);
    problem.b.assign(n, 0.0);
    problem.fixed.assign(n / B, 0);
    problem.start.assign(n, 0.0);
    const auto transfer = [&] { return registry.create<Transfer<B>>("transfer", "min_merge"); };
    levels =
        algebraic_hierarchy<B>(problem, transfer, enough_vectors, {.coarsening = coarsening}, near_null, aggregator);
    problem.galerkin = levels.matrices;
  }
};

}  // namespace

template <int B>
LinearSolve algebraic_cg(const SparseRows& A, std::span<const double> b, double tolerance, Coarsening coarsening,
                         const NearNullSpace& near_null, const Aggregator& aggregator) {
  Stopwatch watch;
  AlgebraicProblem<B> given(A, coarsening, near_null, aggregator);
  given.problem.b.assign(b.begin(), b.end());
  const double hierarchy = watch.elapsed();
  LinearSolve result = multigrid_cg<B>(given.problem, given.levels.prolongations, given.registry, tolerance);
  result.setup += hierarchy;
  result.complexity = complexity(given.problem.A, given.levels);
  return result;
}

template LinearSolve multigrid_cg(const DiscreteProblem<1>&, std::span<const Prolongation>, const Registry&, double);
template LinearSolve multigrid_cg(const DiscreteProblem<2>&, std::span<const Prolongation>, const Registry&, double);
template LinearSolve multigrid_cg(const DiscreteProblem<3>&, std::span<const Prolongation>, const Registry&, double);
template LinearSolve algebraic_cg<1>(const SparseRows&, std::span<const double>, double, Coarsening,
                                     const NearNullSpace&, const Aggregator&);
template LinearSolve algebraic_cg<3>(const SparseRows&, std::span<const double>, double, Coarsening,
                                     const NearNullSpace&, const Aggregator&);

}  // namespace signorini::bench
