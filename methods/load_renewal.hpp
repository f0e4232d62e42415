#pragma once
#include <vector>

#include "core/solver/following_load.hpp"
#include "methods/paired_acceleration.hpp"

namespace signorini {

/// The largest change over the largest of what changes, or FollowingLoad::size().
template <int B>
double relative_change(const std::vector<double>& change, const FollowingLoad<B>& load);

/// Renews a load that follows the solution (core/solver/following_load.hpp) after each cycle, and accelerates the
/// iteration of both while most phases rest.
template <int B>
class LoadRenewal {
 public:
  /// Keeps references to both.
  /// @param tolerance see PairedAcceleration
  LoadRenewal(FollowingLoad<B>& load, const Constraints<B>& constraints, double tolerance)
      : load_(load), acceleration_(constraints, tolerance) {}

  /// What a renewal has done.
  struct Renewed {
    bool combined = false;  ///< x is no longer the cycle's own, and r is not its residual
    double squared = 0;     ///< of the change, measured by S
    double change = 0;      ///< the largest one over the largest of what changes
  };
  /// Whether changes have grown so much that they will not shrink: S stands for too little there.
  bool diverges() const { return squared_ > far * least_; }
  /// After a cycle from x_before, with the residual r_before, to x with r, both for the load of now. r becomes the
  /// residual of x for the new load, but where x is accelerated.
  /// @param accelerated whether to accelerate: where few phases changed
  Renewed renew(const std::vector<double>& x_before, const std::vector<double>& r_before, std::vector<double>& x,
                std::vector<double>& r, bool accelerated);

 private:
  bool combine(std::vector<double>& x);

  static constexpr double far = 1e24;  // squares of changes, over the least one

  FollowingLoad<B>& load_;
  double squared_ = 0, least_ = infinity;  // of the last change, and of all
  PairedAcceleration<B> acceleration_;
  std::vector<double> change_, S_change_, no_residual_;
};

}  // namespace signorini
