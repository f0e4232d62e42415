#include "apps/bench/shares/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/problems.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/base/error.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini::bench {
namespace {

template <int D, int B>
DiscreteProblem<B> finest_problem(const Problem& problem, bool bounded) {
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  Model<B> model = build_model<B>(problem.scene, D, problem.registry, 1);
  if (!bounded) model.obstacles.clear();
  return discretize<D, B>(Nodes(hierarchy.finest()), model).problem;
}

/// A finest level and the iterate that it sweeps over.
template <int B>
struct Swept {
  DiscreteProblem<B> problem;
  std::vector<double> x = problem.start;
  Level<B> level = finest_level(problem);

  explicit Swept(DiscreteProblem<B> p) : problem(std::move(p)) { level.x = x.data(); }
  Swept(const Swept&) = delete;
  Swept& operator=(const Swept&) = delete;

  void sweep() { level.sweep(Order::forward); }
};

/// Projected Gauss-Seidel for a scalar problem in plain arrays, without any interface.
class ByHand {
 public:
  explicit ByHand(const DiscreteProblem<1>& problem)
      : problem_(problem),
        inverse_(problem.b.size()),
        lower_(problem.b.size(), -infinity),
        upper_(problem.b.size(), infinity),
        x_(problem.start) {
    for (std::size_t p = 0; p < inverse_.size(); ++p) inverse_[p] = 1 / *problem.A.diagonal(static_cast<Index>(p));
    const Constraints<1>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot) {
      lower_[c.vector[slot]] = c.lower[slot];
      upper_[c.vector[slot]] = c.upper[slot];
    }
  }

  void sweep() {
    const BlockMatrix<1>& A = problem_.A;
    const Offset* row = A.row.data();
    const Index* column = A.column.data();
    const double* value = A.value.data();
    const double* b = problem_.b.data();
    double* x = x_.data();
    for (Index p = 0, n = A.size(); p < n; ++p) {
      double Ax = 0;
      for (Offset k = row[p]; k < row[p + 1]; ++k) Ax += value[k] * x[column[k]];
      x[p] = std::min(std::max(x[p] + inverse_[p] * (b[p] - Ax), lower_[p]), upper_[p]);
    }
  }

  const std::vector<double>& x() const { return x_; }

 private:
  const DiscreteProblem<1>& problem_;
  std::vector<double> inverse_, lower_, upper_, x_;
};

/// Best times of two sweeps, taken in turns, the first over the second.
template <class First, class Second>
double ratio(First& first, Second& second) {
  constexpr int rounds = 40, sweeps = 4;
  const auto seconds = [](auto& swept) {
    const ProcessorTime time;
    for (int k = 0; k < sweeps; ++k) swept.sweep();
    return time.elapsed();
  };
  double best[2] = {infinity, infinity};
  for (int k = 0; k < rounds; ++k) {
    best[0] = std::min(best[0], seconds(first));
    best[1] = std::min(best[1], seconds(second));
  }
  return best[0] / best[1];
}

void check_equal(const std::vector<double>& x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i] - y[i]) <= 1e-12)) input_error("sweep by hand", "differs from the plugin's");
}

void scalar_row(int nodes) {
  Swept<1> plugin(finest_problem<2, 1>(benchmark_problem("S2", nodes), true));
  ByHand hand(plugin.problem);
  const double over = ratio(plugin, hand);
  check_equal(plugin.x, hand.x());
  fmt::print("| scalar | S2 | {} | the same loop by hand | {:.2f} |\n", plugin.x.size(), over);
}

void contact_row(const char* name, int nodes) {
  const Problem problem = benchmark_problem(name, nodes);
  Swept<3> plugin(finest_problem<3, 3>(problem, true)), linear(finest_problem<3, 3>(problem, false));
  fmt::print("| contact | {} | {} | linear sweep | {:.2f} |\n", name, plugin.x.size(), ratio(plugin, linear));
}

}  // namespace

void print_boundary(bool quick) {
  fmt::print(
      "\n## The plugin boundary\n\n| plugin's sweep | problem | unknowns | over | ratio |\n"
      "| --- | --- | --- | --- | --- |\n");
  scalar_row(quick ? 257 : 513);
  contact_row("E3", quick ? 17 : 33);
  contact_row("E3w", quick ? 17 : 33);
}

}  // namespace signorini::bench
