#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "amg/black_box.hpp"
#include "apps/bench/matrices/linear.hpp"
#include "apps/bench/peers/instance.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/interpolate.hpp"

namespace signorini::bench {
namespace {

/// Which vectors of a level are not prescribed, and in which order solvers get them: along the lines of the grid, as
/// codes for such grids number them.
struct Numbering {
  std::vector<Index> vertex;  ///< per vector
  std::vector<Index> number;  ///< per vertex, -1 where prescribed
};

template <int D, int B>
Numbering along_grid(const Mesh<D>& mesh, const DiscreteProblem<B>& problem) {
  Numbering out;
  out.number = free_vectors(problem);
  for (Index p = 0; p < mesh.vertices(); ++p)
    if (out.number[p] >= 0) out.vertex.push_back(p);
  const auto place = [&mesh](Index p) {
    std::array<long long, D> at;
    for (int i = 0; i < D; ++i) at[D - 1 - i] = std::llround(std::ldexp(mesh.points[p][i], 30));
    return at;
  };
  std::sort(out.vertex.begin(), out.vertex.end(), [&](Index p, Index q) { return place(p) < place(q); });
  for (std::size_t k = 0; k < out.vertex.size(); ++k) out.number[out.vertex[k]] = static_cast<Index>(k);
  return out;
}

/// Fills rows that are added one after the other.
void add_row(SparseRows& A, std::vector<std::pair<Index, double>>& entries) {
  std::sort(entries.begin(), entries.end());
  for (const auto& [column, value] : entries) {
    A.column.push_back(column);
    A.value.push_back(value);
  }
  A.row.push_back(static_cast<Offset>(A.column.size()));
  entries.clear();
}

/// A problem whose unknown i becomes the number to[i].
MatrixProblem renumbered(const MatrixProblem& problem, const std::vector<Index>& to) {
  MatrixProblem out;
  const SparseRows& A = problem.A;
  std::vector<Index> from(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) from[to[i]] = static_cast<Index>(i);
  std::vector<std::pair<Index, double>> entries;
  for (const Index i : from) {
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) entries.emplace_back(to[A.column[k]], A.value[k]);
    add_row(out.A, entries);
    out.b.push_back(problem.b[i]);
    out.lower.push_back(problem.lower[i]);
    out.upper.push_back(problem.upper[i]);
  }
  out.A.rows = out.A.columns = A.rows;
  return out;
}

/// The matrix and bounds of a level, numbered like that.
template <int B>
MatrixProblem matrix_problem(const DiscreteProblem<B>& problem, const Numbering& numbering) {
  std::vector<Index> to;
  for (const Index number : numbering.number)
    for (int i = 0; number >= 0 && i < B; ++i) to.push_back(number * B + i);
  return renumbered(bench::matrix_problem(problem), to);
}

/// The prolongation of a mesh level for unknowns that are not prescribed.
template <int B>
SparseRows free_interpolation(const Prolongation& P, const Numbering& fine, const Numbering& coarse) {
  SparseRows out;
  std::vector<std::pair<Index, double>> entries;
  for (const Index p : fine.vertex)
    for (int i = 0; i < B; ++i) {
      for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
        if (const Index q = coarse.number[P.column[k]]; q >= 0) entries.emplace_back(q * B + i, P.weight[k]);
      add_row(out, entries);
    }
  out.rows = static_cast<Index>(fine.vertex.size()) * B;
  out.columns = static_cast<Index>(coarse.vertex.size()) * B;
  return out;
}

template <int B>
std::vector<Index> free_twins(const Prolongation& P, const Numbering& fine, const Numbering& coarse) {
  std::vector<Index> out;
  const std::vector<Index> twins = P.twins();
  for (const Index q : coarse.vertex)
    for (int i = 0; i < B; ++i) out.push_back(fine.number[twins[q]] * B + i);
  return out;
}

/// One of the benchmark problems with everything that this project's own solvers need.
template <int D, int B>
class Own {
 public:
  Own(const std::string& name, int nodes)
      : problem_(benchmark_problem(name, nodes)),
        hierarchy_(build_hierarchy<D>(problem_.scene, B)),
        prolongations_(prolongations(hierarchy_, nodes_of(hierarchy_))) {}

  Benchmark benchmark(const std::shared_ptr<const Own>& self) {
    Benchmark out;
    out.instance.block = B;
    add_levels(out.instance);
    out.assembly = assembly_seconds<D, B>(model(), hierarchy_);
    discretize_free();
    out.instance.free_load = matrix_problem(free_, numbering_).b;
    out.nested = [self](double tolerance) { return self->nested(tolerance); };
    out.multigrid_cg = [self](double tolerance) { return self->linear(tolerance); };
    const auto finest = discretize<D, B>(Nodes(hierarchy_.finest()), model());
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

  /// The coarse matrices, which all solvers are given, are those that multigrid would compute.
  void discretize_free() {
    Model<B> free = model();
    free.obstacles.clear();
    if (B > 1) free.loads.push_back(downwards());
    for (std::size_t k = 0; k < hierarchy_.levels.size(); ++k) {
      DiscreteProblem<B> problem = discretize<D, B>(Nodes(hierarchy_.levels[k]), free).problem;
      if (k > 0) {
        if (!is_galerkin(free_, prolongations_[k - 1], problem))
          throw std::runtime_error(problem_.name + ": the coarse matrices are not the Galerkin products");
        coarse_.push_back({std::move(free_.A), std::move(free_.fixed), false});
      }
      free_ = std::move(problem);
    }
    free_.galerkin = coarse_;
  }

  void add_levels(Instance& instance) {
    Numbering coarser;
    DiscreteProblem<B> coarse_problem;
    for (std::size_t k = 0; k < hierarchy_.levels.size(); ++k) {
      const Mesh<D>& mesh = hierarchy_.levels[k];
      DiscreteProblem<B> problem = discretize<D, B>(Nodes(mesh), model()).problem;
      numbering_ = along_grid(mesh, problem);
      GridLevel level;
      level.problem = matrix_problem(problem, numbering_);
      for (const Index p : numbering_.vertex)
        for (int i = 0; i < 3; ++i) level.coordinates.push_back(i < D ? mesh.points[p][i] : 0);
      if (k > 0) {
        const Prolongation& P = prolongations_[k - 1];
        level.interpolation = free_interpolation<B>(P, numbering_, coarser);
        level.twin = free_twins<B>(P, numbering_, coarser);
        level.offset = free_values(problem, interpolate(coarse_problem, coarse_problem.start, P, problem));
      }
      instance.levels.push_back(std::move(level));
      coarser = numbering_;
      coarse_problem = std::move(problem);
    }
  }

  /// Global coordinates, without prescribed vectors.
  std::vector<double> free_values(const DiscreteProblem<B>& problem, const std::vector<double>& local) const {
    const std::vector<double> u = to_global(problem, local);
    std::vector<double> out;
    for (const Index p : numbering_.vertex)
      for (int i = 0; i < B; ++i) out.push_back(u[Offset{p} * B + i]);
    return out;
  }

  Reference reference(const DiscreteProblem<B>& problem, const std::vector<double>& x) const {
    std::vector<double> r(x.size());
    signorini::residual<B>(problem.A, x.data(), problem.b.data(), r.data());
    return {free_values(problem, x), std::sqrt(energy_norm_squared(problem, x, r))};
  }

  std::pair<Attempt, Solution<B>> nested_solution(double tolerance) const {
    const Progress quiet;
    Scene::Solver options = problem_.scene.solver;
    options.tolerance = tolerance;
    Times wall;
    const Model<B> model = this->model();
    const Stopwatch watch;
    const ProcessorTime time;
    Solution<B> solution = NestedSolver<D, B>(hierarchy_, options, problem_.registry, quiet, wall).solve(model);
    Attempt out;
    out.seconds = time.elapsed() * (1 - wall.assemble / watch.elapsed());
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
    const ProcessorTime time;
    const LinearSolve solve = multigrid_cg<B>(free_, prolongations_, problem_.registry, tolerance);
    return {time.elapsed(), solve.iterations, free_values(free_, solve.x)};
  }

  Problem problem_;
  MeshHierarchy<D> hierarchy_;
  std::vector<Prolongation> prolongations_;
  Numbering numbering_;      // of the finest level
  DiscreteProblem<B> free_;  // without the obstacle
  std::vector<GalerkinMatrix<B>> coarse_;
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
    const ProcessorTime time;
    BlackBox solver(problem.A, instance.block, options);
    BlackBox::Result result = solver.solve(problem.b, problem.lower, problem.upper);
    if (!result.summary.converged()) throw std::runtime_error(result.summary.reason);
    return Attempt{time.elapsed(), result.summary.iterations, std::move(result.x)};
  };
}

Solver algebraic_cg(const Instance& instance) {
  return [&instance](double tolerance) {
    const auto& A = instance.finest().A;
    const ProcessorTime time;
    LinearSolve solve = instance.block == 3 ? algebraic_cg<3>(A, instance.free_load, tolerance)
                                            : algebraic_cg<1>(A, instance.free_load, tolerance);
    return Attempt{time.elapsed(), solve.iterations, std::move(solve.x)};
  };
}

}  // namespace signorini::bench
