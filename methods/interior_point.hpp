#pragma once
#include "core/component/registry.hpp"
#include "core/solver/iteration.hpp"
#include "methods/sparse_system.hpp"

namespace signorini {

/// Primal-dual interior points with a predictor and a corrector (Mehrotra, SIAM J. Optim. 2, 1992; Nocedal and Wright,
/// Numerical Optimization, 16.6): a few dozen linear systems whatever the bounds and the signs of the couplings, for
/// semidefinite matrices as well. What is measured and returned is the iterate with those components on their bounds
/// that are nearer to them than their multipliers are to zero; its energy may grow from step to step.
template <int B>
class InteriorPointIteration final : public Iteration<B> {
 public:
  /// @param linear a registered linear solver
  InteriorPointIteration(const DiscreteProblem<B>& problem, std::vector<double>& x, const SolverOptions& options,
                         const Registry& registry, const std::string& linear);

 private:
  using typename Iteration<B>::Step;

  /// A bound of component i: distance sign * (x_i - value) > 0 and multiplier > 0, whose product goes to zero.
  struct Side {
    Offset i;
    double sign, value;
    double distance = 0, multiplier = 0;
    double distance_step = 0, multiplier_step = 0;
  };

  const Level<B>& finest() const override { return level_; }
  std::vector<Index> unknowns() const override { return {this->free_unknowns(level_)}; }
  std::string method() const override { return "interior_point"; }
  Step advance() override;
  void add_work(Stage& stage) const override;
  std::optional<double> response(const std::vector<double>& forces, double enough) override;

  void collect_sides();
  void start();
  bool factorise();
  bool predict_and_correct();
  bool find_direction(double complementarity, bool correct);
  double longest_step() const;
  void take(double step);
  double complementarity(double step) const;
  void put_onto_bounds();
  double error_bound() const;
  bool progresses(double error);
  LevelReport report() const;

  std::string linear_;
  Level<B> level_;
  SparseSystem<B> system_;
  std::vector<Side> sides_;
  std::vector<char> held_;             // per unknown: both bounds are the same
  std::vector<double> y_, force_, d_;  // the iterate, b - A y, and the direction
  std::vector<double> added_;
  bool started_ = false;
  double least_error_ = infinity;
  int idle_ = 0;
};

}  // namespace signorini
