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
  void correct(const std::vector<double>& x, std::vector<double>& change, std::vector<double>& residual) override;
  void add(const std::vector<double>& change, std::vector<double>& r) override;
  double squared() const override;
  /// The rows that tell reactions know the load, too: once, at the end.
  void press_on_prescribed();

 private:
  DiscreteProblem<D>& problem() const { return discretization_.problem; }
  const std::vector<double>& load_of(const std::vector<double>& p);
  void subtract(const std::vector<double>& load);

  const PressureSpace<D>& space_;
  Discretization<D>& discretization_;
  std::vector<double> p_;
  std::vector<double> value_;             // of the space, in local coordinates
  std::vector<double> inverse_;           // of the diagonal of what stands for the Schur complement
  std::vector<double> load_;              // C'p of the call before, D per node
  std::vector<double> step_, remaining_;  // of the solution with that
};

}  // namespace signorini
