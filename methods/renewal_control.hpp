#pragma once
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// When cycles renew what functionals that follow the solution keep frozen (the normal force in Coulomb's bound), and
/// by how much. Where that is no contraction the iterates go round: then they are damped, and given up in the end, for
/// there may be no solution, or several.
class RenewalControl {
 public:
  /// Replaces what was frozen in the last cycle by what is to be frozen in the next one.
  /// @param follows what follows from its iterate
  void next(const std::vector<double>& follows, std::vector<double>& frozen);
  /// A cycle has ended with this natural residual.
  void add(double natural_residual);
  /// Why it makes no sense to go on; empty: it does.
  std::string stuck() const;

 private:
  void relax(const std::vector<double>& follows, const std::vector<double>& frozen);

  static constexpr int patience = 15;    ///< cycles in which the residual has to fall
  static constexpr double enough = 0.7;  ///< to so much of what it was
  static constexpr double least_part = 1.0 / 16, least_relaxation = 1.0 / 8;

  double part_ = 1, relaxation_ = 1, least_ = infinity;
  std::vector<double> difference_;  // of what followed last and what was frozen
  int idle_ = 0;
};

}  // namespace signorini
