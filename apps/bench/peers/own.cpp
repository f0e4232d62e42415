#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "amg/black_box.hpp"
#include "apps/bench/linear.hpp"
#include "apps/bench/peers/instance.hpp"
#include "apps/bench/problems.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/fem/nested.hpp"
#include "core/solver/convergence.hpp"

namespace signorini::bench {
namespace {

/// The prolongation of a mesh level for the unknowns of its vectors that are not prescribed.
template <int B>
SparseRows free_interpolation(const Prolongation& P, const std::vector<Index>& fine, const std::vector<Index>& coarse,
                              const GridLevel& level, const GridLevel& coarser) {
  SparseRows out;
  out.rows = static_cast<Index>(level.problem.b.size());
  out.columns = static_cast<Index>(coarser.problem.b.size());
  for (Index p = 0; p < P.fine(); ++p) {
    if (fine[p] < 0) continue;
    for (int i = 0; i < B; ++i) {
      for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
        const Index q = coarse[P.column[k]];
        if (q < 0) continue;
        out.column.push_back(q * B + i);
        out.value.push_back(P.weight[k]);
      }
      out.row.push_back(static_cast<Offset>(out.column.size()));
    }
  }
  return out;
}

template <int B>
std::vector<Index> free_twins(const Prolongation& P, const std::vector<Index>& fine, const std::vector<Index>& coarse) {
  std::vector<Index> out;
  const std::vector<Index> twins = P.twins();
  for (std::size_t q = 0; q < coarse.size(); ++q)
    for (int i = 0; coarse[q] >= 0 && i < B; ++i) out.push_back(fine[static_cast<std::size_t>(twins[q])] * B + i);
  return out;
}

/// One of the benchmark problems with everything that this project's own solvers need.
template <int D, int B>
class Own {
 public:
  Own(const std::string& name, int nodes)
      : problem_(benchmark_problem(name, nodes)), hierarchy_(build_hierarchy<D>(problem_.scene, B)) {
    for (std::size_t k = 0; k < hierarchy_.refinements.size(); ++k)
      prolongations_.push_back(prolongation(hierarchy_.refinements[k], hierarchy_.levels[k].vertices()));
  }

  Benchmark benchmark(const std::shared_ptr<const Own>& self) {
    Benchmark out;
    out.instance.block = B;
    add_levels(out);
    Model<B> free = model();
    free.obstacles.clear();
    if (B > 1) free.loads.push_back(downwards());
    free_ = discretize<D, B>(hierarchy_.finest(), free).problem;
    out.instance.free_load = matrix_problem(free_).b;
    out.nested = [self](double tolerance) { return self->nested(tolerance); };
    out.multigrid_cg = [self](double tolerance) { return self->linear(tolerance); };
    const auto finest = discretize<D, B>(hierarchy_.finest(), model());
    out.bounded = reference(finest.problem, nested_solution(rounding).second.x);
    out.unbounded = reference(free_, multigrid_cg<B>(free_, prolongations_, problem_.registry, rounding).x);
    return out;
  }

 private:
  static constexpr double rounding = 1e-12;

  Model<B> model() const { return build_model<B>(problem_.scene, D, problem_.registry, 1); }

  /// Without a load the elastic cube without an obstacle would only be moved.
  static Load<B> downwards() {
    Load<B> load;
    load.value[B - 1] = -1;
    return load;
  }

  void add_levels(Benchmark& out) {
    std::vector<Index> coarser;
    DiscreteProblem<B> coarse_problem;
    for (std::size_t k = 0; k < hierarchy_.levels.size(); ++k) {
      Stopwatch watch;
      DiscreteProblem<B> problem = discretize<D, B>(hierarchy_.levels[k], model()).problem;
      out.assembly += watch.elapsed();
      GridLevel level;
      level.problem = matrix_problem(problem);
      number_ = free_vectors(problem);
      add_coordinates(hierarchy_.levels[k], level);
      if (k > 0) connect(level, out.instance.levels.back(), prolongations_[k - 1], coarser, coarse_problem, problem);
      out.instance.levels.push_back(std::move(level));
      coarser = number_;
      coarse_problem = std::move(problem);
    }
  }

  void connect(GridLevel& level, const GridLevel& coarser, const Prolongation& P, const std::vector<Index>& coarse,
               const DiscreteProblem<B>& coarse_problem, const DiscreteProblem<B>& problem) const {
    level.interpolation = free_interpolation<B>(P, number_, coarse, level, coarser);
    level.twin = free_twins<B>(P, number_, coarse);
    level.offset = free_values(problem, interpolate(coarse_problem, coarse_problem.start, P, problem));
  }

  void add_coordinates(const Mesh<D>& mesh, GridLevel& level) const {
    for (std::size_t p = 0; p < number_.size(); ++p)
      for (int i = 0; number_[p] >= 0 && i < 3; ++i) level.coordinates.push_back(i < D ? mesh.points[p][i] : 0);
  }

  /// Global coordinates, without prescribed vectors.
  std::vector<double> free_values(const DiscreteProblem<B>& problem, const std::vector<double>& local) const {
    const std::vector<double> u = to_global(problem, local);
    std::vector<double> out;
    for (std::size_t p = 0; p < number_.size(); ++p)
      for (int i = 0; number_[p] >= 0 && i < B; ++i) out.push_back(u[p * B + i]);
    return out;
  }

  Reference reference(const DiscreteProblem<B>& problem, const std::vector<double>& x) const {
    std::vector<double> r(x.size());
    signorini::residual<B>(problem.A, x.data(), problem.b.data(), r.data());
    return {free_values(problem, x), std::sqrt(energy_norm_squared(problem, x, r))};
  }

  std::pair<Attempt, Solution<B>> nested_solution(double tolerance) const {
    const Progress quiet(true);
    Scene::Solver options = problem_.scene.solver;
    options.tolerance = tolerance;
    Times times;
    Stopwatch watch;
    Solution<B> solution = NestedSolver<D, B>(hierarchy_, options, problem_.registry, quiet, times).solve(model());
    Attempt out;
    out.seconds = watch.elapsed() - times.assemble;
    out.iterations = solution.summary.iterations;
    if (!solution.summary.converged()) throw std::runtime_error(solution.summary.reason);
    return {std::move(out), std::move(solution)};
  }

  Attempt nested(double tolerance) const {
    auto [out, solution] = nested_solution(tolerance);
    out.x = free_values(solution.discretization.problem, solution.x);
    return out;
  }

  Attempt linear(double tolerance) const {
    const LinearSolve solve = multigrid_cg<B>(free_, prolongations_, problem_.registry, tolerance);
    return {solve.setup + solve.solve, solve.iterations, free_values(free_, solve.x)};
  }

  Problem problem_;
  MeshHierarchy<D> hierarchy_;
  std::vector<Prolongation> prolongations_;
  std::vector<Index> number_;  // of the finest level's vectors among the free ones, -1 where prescribed
  DiscreteProblem<B> free_;    // without the obstacle
};

template <int D, int B>
Benchmark make(const std::string& name, int nodes) {
  const auto own = std::make_shared<Own<D, B>>(name, nodes);
  return own->benchmark(own);
}

}  // namespace

Benchmark make_benchmark(const std::string& name, int nodes) {
  if (name == "S2") return make<2, 1>(name, nodes);
  return name == "S3" ? make<3, 1>(name, nodes) : make<3, 3>(name, nodes);
}

Solver black_box(const Instance& instance) {
  return [&instance](double tolerance) {
    SolverOptions options;
    options.tolerance = tolerance;
    const MatrixProblem& problem = instance.finest();
    Stopwatch watch;
    BlackBox solver(problem.A, instance.block, options);
    BlackBox::Result result = solver.solve(problem.b, problem.lower, problem.upper);
    if (!result.summary.converged()) throw std::runtime_error(result.summary.reason);
    return Attempt{watch.elapsed(), result.summary.iterations, std::move(result.x)};
  };
}

Solver algebraic_cg(const Instance& instance) {
  return [&instance](double tolerance) {
    const auto& A = instance.finest().A;
    LinearSolve solve = instance.block == 3 ? algebraic_cg<3>(A, instance.free_load, tolerance)
                                            : algebraic_cg<1>(A, instance.free_load, tolerance);
    return Attempt{solve.setup + solve.solve, solve.iterations, std::move(solve.x)};
  };
}

}  // namespace signorini::bench
