#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"
#include "core/fem/incompressible/pressure_space.hpp"
#include "core/solver/following_load.hpp"

namespace signorini {

/// The load of a pressure on a discrete problem, in its local coordinates.
template <int D>
class PressureLoad final : public FollowingLoad<D> {
 public:
  /// Keeps references to the space and the discretization.
  /// @param p its start
  /// @param thermal_volume see there
  PressureLoad(const PressureSpace<D>& space, Discretization<D>& discretization, std::vector<double> p,
               std::vector<double> thermal_volume = {});

  const std::vector<double>& values() const override { return p_; }
  void apply() override;
  void withdraw() override;
  void set(std::vector<double> values) override;
  void correct(const std::vector<double>& x, std::vector<double>& change, std::vector<double>& residual) override;
  void add(const std::vector<double>& change, std::vector<double>& r) override;
  typename FollowingLoad<D>::Matrices matrices() const override;
  double size() const override { return thermal_size_; }
  double squared() const override;
  /// The rows that tell reactions know the load, too: once, at the end.
  void press_on_prescribed();

 private:
  DiscreteProblem<D>& problem() const { return discretization_.problem; }
  void find_schur();
  void find_shut_in();
  void find_thermal_sizes();
  std::vector<double> constant_in(Index material) const;
  void solve(const std::vector<double>& residual, std::vector<double>& change);
  const std::vector<double>& displacements(const std::vector<double>& x);
  const std::vector<double>& load_of(const std::vector<double>& p);
  void renew_load();

  const PressureSpace<D>& space_;
  Discretization<D>& discretization_;
  std::vector<double> p_, thermal_volume_;
  double thermal_size_ = 0, thermal_energy_ = 0;  // of what is held: a pressure; half the work that p does then
  bool applied_ = false;
  std::vector<double> own_;  // b without the load, while it is applied, and the work likewise
  double own_work_ = 0;
  std::vector<double> value_;             // of the space, in local coordinates; where unknowns are jumps in global ones
  std::vector<double> displacements_;     // then
  std::vector<double> schur_;             // what stands for the Schur complement C A^-1 C' + M
  std::vector<double> inverse_;           // of its diagonal
  std::vector<double> load_;              // C'p of the call before, D per node
  std::vector<double> step_, remaining_;  // of the solution with that
  /// A pressure that is constant in what is prescribed all around, and what of the force along it is added.
  struct ShutIn {
    std::vector<double> pressure;
    double more;
  };
  std::vector<ShutIn> shut_in_;
};

}  // namespace signorini
