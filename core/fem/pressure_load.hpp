#pragma once
#include <vector>

#include "core/fem/discretize.hpp"
#include "core/fem/pressure_space.hpp"
#include "core/solver/following_load.hpp"

namespace signorini {

/// The load of a pressure on a discrete problem, in its local coordinates.
template <int D>
class PressureLoad final : public FollowingLoad<D> {
 public:
  /// Keeps references to all but p, its start.
  PressureLoad(const PressureSpace<D>& space, Discretization<D>& discretization, std::vector<double> p);

  const std::vector<double>& values() const override { return p_; }
  void apply() override;
  void withdraw() override;
  void correct(const std::vector<double>& x, std::vector<double>& change, std::vector<double>& residual) override;
  void add(const std::vector<double>& change, std::vector<double>& r) override;
  double squared() const override;
  std::size_t directions() const override { return along_.size(); }
  double along(std::size_t e) const override { return along_[e]; }
  std::vector<double> load_along(std::size_t e) override;
  double own(std::size_t e) const override { return own_[e]; }
  void set_resistance(std::size_t e, double resistance) override;
  /// The rows that tell reactions know the load, too: once, at the end.
  void press_on_prescribed();

 private:
  DiscreteProblem<D>& problem() const { return discretization_.problem; }
  void find_schur();
  void find_directions();
  bool contains(std::size_t e, Index k) const { return e == materials_ || space_.material[k] == static_cast<Index>(e); }
  void solve(const std::vector<double>& residual, std::vector<double>& change);
  const std::vector<double>& displacements(const std::vector<double>& x);
  const std::vector<double>& load_of(const std::vector<double>& p);
  void subtract(const std::vector<double>& load);

  const PressureSpace<D>& space_;
  Discretization<D>& discretization_;
  std::vector<double> p_;
  std::vector<double> value_;             // of the space, in local coordinates; where unknowns are jumps in global ones
  std::vector<double> displacements_;     // then
  std::vector<double> schur_;             // what stands for the Schur complement C A^-1 C' + M
  std::vector<double> inverse_;           // of its diagonal
  std::vector<double> load_;              // C'p of the call before, D per node
  std::vector<double> step_, remaining_;  // of the solution with that
  // Of the pressures that are constant in a material, then of the one that is constant in all, where there are several:
  // what is known along it, and what of the correction is added, at first and now.
  const std::size_t materials_;
  std::vector<double> along_, own_, resistance_, more_at_first_, more_;
};

}  // namespace signorini
