#pragma once
#include <vector>

#include "core/solver/following_load.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/paired_acceleration.hpp"

namespace signorini {

/// Renews a load that follows the solution (core/solver/following_load.hpp) after each cycle, and makes the iteration
/// of both fast: accelerates it while the phases rest, and finds what resists directions along which it is slow.
template <int B>
class LoadRenewal {
 public:
  /// Keeps references to both.
  LoadRenewal(FollowingLoad<B>& load, MonotoneMultigrid<B>& multigrid)
      : load_(load),
        multigrid_(multigrid),
        acceleration_(multigrid.finest().constraints),
        watched_(load.directions()) {}

  /// What a renewal has done.
  struct Renewed {
    bool combined = false;  ///< x is no longer the cycle's own, and r is not its residual
    double squared = 0;     ///< of the change, measured by S
    double change = 0;      ///< the largest one over the largest of what changes
  };
  /// After a cycle from x_before, with the residual r_before, to x with r, both for the load of now. r becomes the
  /// residual of x for the new load, but where x is accelerated.
  /// @param accelerated whether to accelerate, and to keep what is known of resistances: where few phases changed
  Renewed renew(const std::vector<double>& x_before, const std::vector<double>& r_before, std::vector<double>& x,
                std::vector<double>& r, bool accelerated);

 private:
  /// Along a direction of the load: the force after the last cycle, how many cycles hardly changed it, and whether its
  /// resistance has been found.
  struct Watched {
    double along = 0;
    int slow = 0;
    bool known = false;
  };

  void watch(const std::vector<double>& x, bool resting);
  void find_resistance(std::size_t e, const std::vector<double>& x);
  bool combine(std::vector<double>& x);

  FollowingLoad<B>& load_;
  MonotoneMultigrid<B>& multigrid_;
  PairedAcceleration<B> acceleration_;
  std::vector<Watched> watched_;
  std::vector<double> change_, S_change_, unused_;
};

}  // namespace signorini
