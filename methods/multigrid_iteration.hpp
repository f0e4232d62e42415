#pragma once
#include "core/solver/iteration.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/recombination.hpp"
#include "methods/configuration.hpp"
#include "methods/load_renewal.hpp"
#include "methods/renewal_control.hpp"
#include "methods/stages.hpp"

namespace signorini {

/// Cycles of multigrid as steps, accelerated while the phases rest. With method "auto" they end with Outcome::stuck
/// where their patience ends, if another method suits the problem.
template <int B>
class MultigridIteration final : public Iteration<B> {
 public:
  /// @param situation of method "auto", before any cycle
  MultigridIteration(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                     std::vector<double>& x, const SolverOptions& options, Components<B> components,
                     const automatic::Situation& situation = {},
                     const automatic::Patience& patience = automatic::patience_with_cycles);

  /// Whether that is how it ended.
  bool lost_patience() const { return lost_patience_; }

 private:
  using typename Iteration<B>::Step;
  using typename Iteration<B>::Sums;

  const Level<B>& finest() const override { return multigrid_.finest(); }
  std::vector<Index> unknowns() const override;
  std::string method() const override;
  Step advance() override;
  std::optional<double> response(const std::vector<double>& forces, double enough) override;
  void begin_where_it_rests();
  void renew();
  bool goes_without_bounds() const;
  void compare_gains(bool free, bool cut_off);
  bool loses_patience() const;
  bool accelerate(const CycleReport& cycle, bool gaining);
  void renew_load(const LevelReport& finest);
  bool take_combination(const CycleReport& cycle);
  void set_forces();
  void renew_forces();
  double remaining_error() const;
  void add_gain();
  double rounding_of_gain() const;

  Method method_;
  automatic::Situation situation_;
  automatic::Patience patience_;
  bool lost_patience_ = false;
  std::vector<Prolongation> own_;  // empty unless a single level has functionals
  MonotoneMultigrid<B> multigrid_;
  Recombination<B> recombination_;
  std::optional<LoadRenewal<B>> load_;        // where one follows the solution
  bool blocks_;                               // among the interpolations' weights
  bool smooth_;                               // the interpolation to the finest level has no kinks
  bool may_turn_;                             // "auto" may make corrections without bounds
  bool nonlinear_;                            // obstacles add to the energy
  bool rests_ = false;                        // few phases changed in the last cycle
  bool bounds_pay_ = true, cut_off_ = false;  // the latter: the last correction, which had no bounds, by bounds
  double amplification_ = 0;                  // of rounding in the residual that the last cycle began with
  double last_gain_ = 0, gain_without_bounds_ = infinity;  // the latter: of the correction after which bounds came back
  int cycles_ = 0, bounded_cycles_ = 0;
  ErrorEstimate estimate_;
  RenewalControl renewal_;
  std::vector<double> data_trial_;              // empty without acceleration
  std::vector<double> forces_, forces_before_;  // empty without functionals
};

}  // namespace signorini
