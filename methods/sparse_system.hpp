#pragma once
#include <algorithm>
#include <memory>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/linear_solver.hpp"

namespace signorini {

/// A block for each of some vectors.
template <int B>
class VectorBlocks {
 public:
  explicit VectorBlocks(Index vectors) : place_(static_cast<std::size_t>(vectors), -1) {}

  void clear() {
    std::fill(place_.begin(), place_.end(), -1);
    value_.clear();
  }
  /// Null where vector p has none.
  const double* at(Index p) const { return place_[p] < 0 ? nullptr : value_.data() + place_[p]; }
  /// That of vector p, new ones zero; valid until the next one is added.
  double* add(Index p) {
    if (place_[p] < 0) {
      place_[p] = static_cast<Offset>(value_.size());
      value_.resize(value_.size() + B * B);
    }
    return value_.data() + place_[p];
  }

 private:
  std::vector<Offset> place_;
  std::vector<double> value_;
};

/// How the matrix of a linear system differs from A.
template <int B>
struct SystemChange {
  explicit SystemChange(Index vectors)
      : held(static_cast<std::size_t>(vectors) * B), added(static_cast<std::size_t>(vectors) * B), turned(vectors) {}

  std::vector<char> held;     ///< per unknown: 0, or not moved
  std::vector<double> added;  ///< per unknown: >= 0, to the diagonal
  VectorBlocks<B> turned;     ///< orthonormal columns: `held` and `added` count along them where a vector has some
};

/// Linear systems with a block matrix A some of whose unknowns are held and whose diagonal is increased, solved by a
/// linear solver that knows the pattern once for all of them.
template <int B>
class SparseSystem {
 public:
  /// Keeps a reference to A.
  SparseSystem(const BlockMatrix<B>& A, std::unique_ptr<LinearSolver> linear);

  /// Of A.
  double diagonal(Offset i) const;

  /// Of the next matrix; stays as it is from factorise() on until the last solve() with it.
  SystemChange<B>& change() { return change_; }
  /// @return whether the matrix is positive definite, as far as that is seen here
  bool factorise();
  /// Replaces the right-hand side by the solution, which is zero along what is held. Returns whether that was possible.
  bool solve(std::vector<double>& b);

  int factorisations() const { return factorisations_; }
  int solves() const { return solves_; }

 private:
  template <class Visit>
  void visit_lower_triangle(const Visit& visit) const;
  void changed_block(Index p, Offset m, double* M) const;
  template <class Turn>
  void turn(std::vector<double>& b, const Turn& turn) const;

  const BlockMatrix<B>& A_;
  std::unique_ptr<LinearSolver> linear_;
  SystemChange<B> change_;
  std::vector<double> value_, scale_;
  int factorisations_ = 0, solves_ = 0;
};

}  // namespace signorini
