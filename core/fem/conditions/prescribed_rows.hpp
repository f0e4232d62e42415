#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// The rows of a matrix at the vectors with prescribed components, from before these are eliminated, in local
/// coordinates. They tell the forces there, and as the matrix is symmetric all that it couples to what is prescribed.
template <int B>
struct PrescribedRows {
  std::vector<Index> vertex;        ///< the nodes, ascending
  std::vector<Offset> first = {0};  ///< vertices + 1: where each row begins
  std::vector<Index> column;        ///< the row's own vertex first
  std::vector<double> value;        ///< B * B per column, row-major
  std::vector<double> load;         ///< B per vertex: b there

  /// Copies the next row.
  void add(const BlockMatrix<B>& A, Index p);
  /// Takes over the loads at the vertices from a right-hand side without prescribed values.
  void take_load(const std::vector<double>& b);
  /// Other coordinates of the columns: value_pq <- value_pq Q_q.
  void rotate_columns(const Frames<B>& frames);
  /// The number of a vertex's row, which exists.
  Index at(Index p) const;
  /// along . (A x - b) in row k: the force that acts on the body there, with `along` in local coordinates; 0 where the
  /// terms cancel but for rounding.
  double force(Index k, const double* along, const std::vector<double>& x) const;
};

/// Prescribed components whose elimination from the matrix is done take the values of problem.start: b, which is that
/// of the loads alone before, and what the energy loses by them, as by eliminate().
template <int B>
void prescribe(DiscreteProblem<B>& problem, const PrescribedRows<B>& rows);

}  // namespace signorini
