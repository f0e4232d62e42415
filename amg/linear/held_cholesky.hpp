#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Entries per vector of a matrix up to which it is about that of a tree: its factor has hardly more.
inline constexpr Offset blocks_of_a_tree = 4;

/// L D L' of a sparse symmetric positive semidefinite matrix with a diagonal of ones. Where a pivot vanishes there is a
/// motion without energy, and a spring holds its component: what is factorised is the matrix plus one on the diagonal
/// there. That leaves the solutions of consistent systems as they are, and does not magnify what rounding does along
/// the motions. One pass, row by row (Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, section 4.8), however
/// many components are held.
/// @tparam Real double, or long double for what it would round away
template <class Real>
class BasicHeldCholesky {
 public:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  /// @param S its lower triangle is used
  /// @param most_operations returns false, and knows nothing, where it would take more
  /// @param no_pivot up to which a pivot vanishes
  bool factorise(const Eigen::SparseMatrix<double>& S, double most_operations = infinity, Real no_pivot = 1e-11);
  Vector solve(const Vector& b) const;
  Eigen::Index size() const { return static_cast<Eigen::Index>(pivot_.size()); }
  /// Each spring stands for one motion without energy: that which it alone resists, solve() of its unit vector.
  const std::vector<Eigen::Index>& held() const { return held_; }
  /// Of the components that are not held.
  Real smallest_pivot() const;
  /// A direction d with d'Sd < 0, but for rounding: that of the first pivot that is clearly negative. Empty: there is
  /// none.
  Vector falling_direction() const;

 private:
  using Upper = Eigen::SparseMatrix<double>;  // of the reordered matrix, in columns
  bool has_known_pattern(const Eigen::SparseMatrix<double>& S);
  double analyse(const Upper& S);
  void solve_transposed(Vector& x) const;
  void factorise_row(const Upper& S, int k, std::vector<int>& seen, std::vector<Real>& y);

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_, inverse_;
  std::vector<int> pattern_start_, pattern_row_;  // of the matrix that they were found for
  std::vector<int> parent_;                       // in the elimination tree
  std::vector<Eigen::Index> start_;               // of the columns of L, without its diagonal of ones
  std::vector<Eigen::Index> end_;                 // of what is known of them
  std::vector<int> row_;
  std::vector<Real> value_, pivot_;
  std::vector<Eigen::Index> held_;
  Eigen::Index falling_ = -1;        // row of the first negative pivot
  std::vector<int> pattern_, path_;  // of one row
};

using HeldCholesky = BasicHeldCholesky<double>;

}  // namespace signorini
