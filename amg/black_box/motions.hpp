#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// The motions of a positive semidefinite matrix, the directions d with A d = 0 but for rounding, component by
/// component of its graph and without iterating. Where the diagonal dominates, the signs of the couplings tell; other
/// components are factorised where that is cheap. The time is linear in their number.
template <int B>
class Motions {
 public:
  /// @param A with a positive diagonal
  /// @throws Error(Exit::input) where a component is seen to be indefinite
  explicit Motions(const BlockMatrix<B>& A);

  /// Whether all components are known to be positive semidefinite, and all motions are known.
  bool complete() const { return complete_; }

  /// Whether there is none for sure, by the signs of couplings and diagonals that dominate.
  bool regular() const { return regular_; }

  struct Fall {
    std::optional<Offset> row;      ///< the unknown that moves most; nothing: no motion is known to fall
    std::optional<Offset> unclear;  ///< the same of one that rounding does not tell from one with a weak support
    bool certain;                   ///< if not, there may be one all the same
  };

  /// Whether b does work, by more than rounding, along a motion that no bound ends: then 1/2 x'Ax - b'x has no minimum.
  Fall fall(const std::vector<double>& b, const Constraints<B>& constraints) const;

 private:
  /// Of one component.
  struct Basis {
    std::vector<Offset> row;  ///< its unknowns
    Eigen::VectorXd scale;    ///< the motions are scale times the columns of `value`, which are orthogonal
    Eigen::MatrixXd value;
    double error;  ///< of such a column, of length one, from the rounding in A
    bool clear;    ///< if not, a support may resist that is too weak to be told from rounding
  };

  class Finder;

  /// Empty where there is none.
  static Eigen::VectorXd falling_direction(const Basis& basis, const std::vector<double>& b,
                                           const Constraints<B>& constraints, bool& certain);

  std::vector<Basis> bases_;
  bool complete_ = true, regular_ = false;
};

}  // namespace signorini
