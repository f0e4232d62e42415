#pragma once
#include "core/component/registry.hpp"
#include "core/solver/iteration.hpp"
#include "methods/held_sides.hpp"
#include "methods/sparse_system.hpp"

namespace signorini {

/// Primal-dual interior points with a predictor and a corrector (Mehrotra, SIAM J. Optim. 2, 1992; Nocedal and Wright,
/// Numerical Optimization, 16.6): a few dozen linear systems whatever the bounds and the signs of the couplings, for
/// semidefinite matrices as well. What is measured and returned is the iterate with those components on their bounds
/// that are nearer to them than their multipliers are to zero; its energy may grow from step to step. Facets are bounds
/// like others, but the iterate need not be within them from the start on.
template <int B>
class InteriorPointIteration final : public Iteration<B> {
 public:
  /// @param linear a registered linear solver
  InteriorPointIteration(const DiscreteProblem<B>& problem, std::vector<double>& x, const SolverOptions& options,
                         const Registry& registry, const std::string& linear);

 private:
  using typename Iteration<B>::Step;

  /// normal . x >= value at a vector: distance normal . x - value > 0 and multiplier > 0, whose product goes to zero.
  struct Side {
    Index p;
    int component;  ///< whose bound it is: the normal is its axis or the opposite; -1: a facet
    double normal[B], value;
    double distance = 0, multiplier = 0;
    double distance_step = 0, multiplier_step = 0;
    double missing = 0;  ///< of a facet: what normal . x - value is more than the distance, which is positive at once

    double along(const std::vector<double>& v) const {
      const double* at = v.data() + Offset{p} * B;
      if (component >= 0) return normal[component] * at[component];
      double sum = 0;
      for (int k = 0; k < B; ++k) sum += normal[k] * at[k];
      return sum;
    }
    /// v += by * normal
    void add(double by, std::vector<double>& v) const {
      double* at = v.data() + Offset{p} * B;
      if (component >= 0) return void(at[component] += by * normal[component]);
      for (int k = 0; k < B; ++k) at[k] += by * normal[k];
    }
  };

  /// A vector with facets, in coordinates the first ones of which equal sides and prescribed components hold.
  struct Corner {
    Index p;
    int held;
    double T[B * B];
  };

  const Level<B>& finest() const override { return level_; }
  std::vector<Index> unknowns() const override { return {this->free_unknowns(level_)}; }
  std::string method() const override { return "interior_point"; }
  Step advance() override;
  void add_work(Stage& stage) const override;
  std::optional<double> response(const std::vector<double>& forces, double enough) override;

  void collect_sides();
  void add_side(Index p, int component, const double* normal, double lower, double upper);
  void add_corner(Index slot);
  void turn_into_springs(const VectorBlocks<B>& springs);
  void start();
  bool factorise();
  bool predict_and_correct();
  bool find_direction(double complementarity, bool correct);
  double longest_step() const;
  void take(double step);
  double complementarity(double step) const;
  void put_onto_bounds();
  void put_onto_facets();
  double error_bound() const;
  bool progresses(double error);
  LevelReport report() const;

  std::string linear_;
  Level<B> level_;
  SparseSystem<B> system_;
  std::vector<Side> sides_;
  std::vector<Corner> corners_;
  std::vector<double> y_, force_, d_;  // the iterate, b - A y, and the direction
  bool started_ = false;
  double least_error_ = infinity;
  int idle_ = 0;
};

}  // namespace signorini
