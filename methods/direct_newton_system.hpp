#pragma once
#include <memory>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/unsymmetric_solver.hpp"
#include "core/solver/following_load.hpp"
#include "methods/newton_system.hpp"

namespace signorini {

/// With a direct solver. Where a load follows the solution (core/solver/following_load.hpp) forces are A v - b + C'p:
/// the rows of v have F C' in p, and below them are the rows C v - M p.
template <int B>
class DirectNewtonSystem final : public NewtonSystem<B> {
 public:
  /// Keeps a reference to A.
  /// @param load null: no p
  DirectNewtonSystem(const BlockMatrix<B>& A, const FollowingLoad<B>* load, std::unique_ptr<UnsymmetricSolver> linear);

  const char* name() const override { return "umfpack"; }
  /// All of v, then all of p.
  Offset size() const override { return Offset{A_.size()} * B + std::ssize(load_.row) - 1; }
  void set_row(Index p, const double* by_force, const double* by_value) override;
  bool factorise() override;
  bool solve(std::vector<double>& b) override;
  int factorisations() const override { return factorisations_; }
  int solves() const override { return solves_; }

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
