#pragma once
#include <array>
#include <map>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/base/types.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Rows of blocks, row-major: the s-th one is out = sum_k weight_k x_{column_k}.
template <int B>
struct BlockRows {
  std::vector<Offset> row{0};
  std::vector<Index> column;   ///< ascending in a row
  std::vector<double> weight;  ///< B * B per column

  const double* at(Offset k) const { return weight.data() + k * B * B; }
  bool operator==(const BlockRows&) const = default;
};

/// A change of basis that makes conditions between nodes local: u = Z x with the displacements u and the unknowns x.
/// Rows of Z and of its inverse are those of the identity but at the vectors that are listed here. Contact between
/// bodies (Wohlmuth and Krause, SIAM J. Sci. Comput. 25, 2003) has jumps as unknowns,
///
///     u_p = x_p + sum_q W_pq u_q      at the vectors p of the slave's side,
///
/// where the sum is the mortar projection of the master's displacements, without what is prescribed at p. What holds
/// bodies together prescribes jumps. All is in global coordinates: frames come after it.
template <int B>
struct Jumps {
  std::vector<Index> vector;  ///< ascending
  BlockRows<B> basis;         ///< Z there: u_p by unknowns
  BlockRows<B> inverse;       ///< Z^-1 there: x_p by displacements
  std::vector<char> given;    ///< per vector: its rows have nothing to do with those of vectors where this is not so
  /// Vectors whose unknown moves many others, too. Of two levels the k-th ones are the same unknown.
  std::vector<Index> common = {};

  Index size() const { return static_cast<Index>(vector.size()); }
  bool operator==(const Jumps&) const = default;
};

/// x <- Z x, and back: B per vector of the whole problem.
template <int B>
void to_displacements(const Jumps<B>& jumps, std::vector<double>& x);
template <int B>
void to_jumps(const Jumps<B>& jumps, std::vector<double>& u);

/// Forces: b <- Z'b, and back. Those on the slave's side stay what they are, the master's gets the counterforces.
template <int B>
void transform_forces(const Jumps<B>& jumps, std::vector<double>& b);
template <int B>
void transform_forces_back(const Jumps<B>& jumps, std::vector<double>& b);

/// Coefficients of some vectors, by vector.
template <int B>
using VectorRow = std::map<Index, std::array<double, B>>;
/// Those of displacements as those of unknowns: c <- c Z.
template <int B>
void transform_row(const Jumps<B>& jumps, VectorRow<B>& c);

/// A <- Z'A Z. Rows next to no side stay as they are.
template <int B>
void transform(const Jumps<B>& jumps, BlockMatrix<B>& A);
/// Memory for the values of Z'A Z, so that they stay where they are: for an A that has its pattern only.
template <int B>
void reserve_couplings(const Jumps<B>& jumps, BlockMatrix<B>& A);

/// Interpolation between unknowns, Z_fine^-1 P Z_coarse.
template <int B>
Prolongation between_jumps(const Prolongation& prolongation, const Jumps<B>& fine, const Jumps<B>& coarse);

}  // namespace signorini
