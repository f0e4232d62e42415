#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/component/registry.hpp"
#include "core/solver/iteration.hpp"
#include "core/solver/prolongation.hpp"
#include "methods/complementarity.hpp"
#include "methods/newton_system.hpp"

namespace signorini {

/// A semismooth Newton method for contact and friction, which solves for a load that follows the solution, too: a
/// reference to compare the other methods with, quadratic once the sets of what touches, sticks and slips rest. Its
/// formulation is its own (complementarity.hpp) and shares nothing with the sweeps. Linear systems are factorised where
/// that is affordable or a load follows, else they are solved by multigrid, to few digits. Iterates may leave
/// the bounds; what is measured and returned is the one next to them that is on them where it touches, and has not
/// moved where it sticks. There is no guarantee that it converges.
template <int B>
class NewtonIteration final : public Iteration<B> {
 public:
  /// Whether there is friction or a load that follows the solution, and nothing that it does not treat.
  static bool suits(const DiscreteProblem<B>& problem);
  /// Error(Exit::input) where an obstacle adds anything but friction to the energy, or there are facets.
  static void check(const DiscreteProblem<B>& problem);
  /// Errors as of check().
  /// @param prolongations coarsest first; none: systems are factorised
  NewtonIteration(const DiscreteProblem<B>& problem, std::vector<double>& x, const SolverOptions& options,
                  const Registry& registry, std::span<const Prolongation> prolongations);

 private:
  using typename Iteration<B>::Step;
  using State = typename Complementarity<B>::State;

  const Level<B>& finest() const override { return level_; }
  std::vector<Index> unknowns() const override { return {this->free_unknowns(level_)}; }
  std::string method() const override { return "newton"; }
  Step advance() override;
  void add_work(Stage& stage) const override;
  std::optional<double> response(const std::vector<double>& forces, double enough) override;

  void read_laws();
  Complementarity<B> equations(Index slot) const;
  void linearise();
  double merit();
  void renew_force();
  bool solve();
  void go(const std::vector<double>& start, double part);
  void measure_load();
  void put_onto_sets();
  double largest_stiffness(Index slot) const;
  bool rests_on(Index slot, int k) const;
  LevelReport report(const std::vector<State>& last) const;

  Level<B> level_;
  FollowingLoad<B>* load_;
  std::unique_ptr<NewtonSystem<B>> system_;
  std::vector<FrictionLaw> laws_;      // per slot
  std::vector<Flags> tangential_;      // per slot
  std::vector<double> stiffness_;      // B per slot
  std::vector<State> states_;          // per slot
  std::vector<double> y_, force_, d_;  // the iterate, A y - b, the step with that of a load
  std::vector<double> change_, of_load_, load_start_;
};

}  // namespace signorini
