#pragma once
#include <memory>
#include <unordered_map>

#include "core/component/registry.hpp"
#include "core/solver/iteration.hpp"
#include "methods/held_sides.hpp"
#include "methods/sparse_system.hpp"

namespace signorini {

/// Primal-dual active sets (Hintermueller, Ito and Kunisch, SIAM J. Optim. 13, 2003) with a linear solver: a reference
/// to compare the other methods with, and what is left where cycles are slow. In each step the components that the
/// multiplier and the distance call active are put onto their bounds, and the energy is minimised over the others. A
/// vector with facets is put onto those that would press on it if it moved alone, and is free along them. Such
/// an iterate may leave the bounds; what is measured and returned is the admissible vector next to it, whose energy may
/// grow from step to step. The method may return to sets that it has left (it then cycles) and needs a regular matrix
/// on the free components: in both cases it is stuck, unless a shift of the diagonal is allowed. That makes steps
/// shorter, and goes again once the sets rest.
template <int B>
class ActiveSetIteration final : public Iteration<B> {
 public:
  /// @param linear a registered linear solver
  /// @param shift_if_singular part of the diagonal that is added to it once the matrix turns out to be singular on the
  ///     free components, or the sets come back; zero: stuck then
  ActiveSetIteration(const DiscreteProblem<B>& problem, std::vector<double>& x, const SolverOptions& options,
                     const Registry& registry, const std::string& linear = "cholmod", double shift_if_singular = 0);

 private:
  using typename Iteration<B>::Step;

  const Level<B>& finest() const override { return level_; }
  std::vector<Index> unknowns() const override { return {this->free_unknowns(level_)}; }
  std::string method() const override { return "pdas"; }
  Step advance() override;
  void add_work(Stage& stage) const override;
  std::optional<double> response(const std::vector<double>& forces, double enough) override;

  double remaining_error(bool changed);
  std::string why_stuck(bool changed);
  void end_damping();
  std::vector<short> predicted() const;
  std::vector<short> at_bounds() const;
  std::vector<short> all_bounded() const;
  bool minimise(bool changed);
  bool factorise();
  HeldSides<B> sides_of(std::size_t at) const;
  bool solve_free();
  template <class Visit>
  void visit_bounds(const Visit& visit) const;
  template <class Visit>
  void visit_polyhedra(const Visit& visit) const;
  template <class Choose>
  void choose_sides(std::vector<short>& active, const Choose& choose) const;
  LevelReport report(const std::vector<short>& last) const;

  std::string linear_;
  Level<B> level_;
  SparseSystem<B> system_;
  std::vector<double> y_, r_y_;  // the iterate, which may leave the bounds, and its residual
  // B per slot: -1 at the lower bound of a component, 1 at the upper one, 0 free; HeldSides where there are facets.
  std::vector<short> active_;
  std::unordered_map<std::size_t, int> seen_;  // fingerprints of the sets of each step
  double shift_if_singular_, shift_ = 0;
  std::vector<double> residuals_;        // since the sets rest
  double last_move_ = infinity;          // of the step before, in the energy norm
  int steps_ = 0, at_rest_ = 0;          // the latter: without a change of the sets
  bool damped_ = false;                  // the shift is there since the sets came back
  int undamped_ = 0, damped_steps_ = 0;  // how often it was taken away again
};

}  // namespace signorini
