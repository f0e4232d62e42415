#pragma once
#include <memory>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/unsymmetric_solver.hpp"
#include "core/solver/following_load.hpp"

namespace signorini {

/// The linear systems of Newton's method for forces f = A v - b + C'p: per vector the rows F A + V in v and F C' in p,
/// with blocks F and V of its own, and below them C v - M p where a load follows the solution (core/solver/
/// following_load.hpp).
template <int B>
class NewtonSystem {
 public:
  /// Keeps a reference to A.
  /// @param load null: no p
  NewtonSystem(const BlockMatrix<B>& A, const FollowingLoad<B>* load, std::unique_ptr<UnsymmetricSolver> linear);

  /// Unknowns: all of v, then all of p.
  Offset size() const { return Offset{A_.size()} * B + std::ssize(load_.row) - 1; }
  /// The rows of vector p, with F = by_force and V = by_value.
  void set_row(Index p, const double* by_force, const double* by_value);
  /// Returns false where the matrix is singular.
  bool factorise();
  /// Replaces the right-hand side by the solution.
  void solve(std::vector<double>& b);

  int factorisations() const { return factorisations_; }
  int solves() const { return solves_; }

 private:
  /// An entry of C in a vector's column.
  struct Entry {
    Index row;
    Offset at;  // in load_.value, over B
  };
  void transpose();
  void add_vector(Index p, std::vector<Offset>& start, std::vector<Index>& column);
  void add_load(Index k, std::vector<Offset>& start, std::vector<Index>& column);

  const BlockMatrix<B>& A_;
  typename FollowingLoad<B>::Matrices load_;
  std::unique_ptr<UnsymmetricSolver> linear_;
  std::vector<Offset> first_;   // per vector, one more: in entries_
  std::vector<Entry> entries_;  // of C by columns
  std::vector<Offset> place_;   // of the first entry of a block's first row in values_, per block of A
  std::vector<Offset> begin_;   // of a vector's rows in values_
  std::vector<double> values_;
  int factorisations_ = 0, solves_ = 0;
};

}  // namespace signorini
