#pragma once
#include <array>
#include <map>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/base/types.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// A change of basis that makes contact between bodies local (Wohlmuth and Krause, SIAM J. Sci. Comput. 25, 2003):
/// where one body, the slave, may touch another one, its unknowns are jumps. With the displacements u and the unknowns
/// x
///
///     u_p = x_p + P_p sum_q w_pq x_q      at the vectors p of the slave's side,    u_p = x_p    elsewhere,
///
/// in short u = Z x. The sum is the mortar projection of the master's displacements, and the projector P_p leaves out
/// of it what is prescribed at p. No vector of the sums is one of the slave's side, so that Z^-1 subtracts what Z adds.
/// All is in global coordinates: frames come after it.
template <int B>
struct Jumps {
  std::vector<Index> vector;    ///< those of the slave's side, ascending
  std::vector<Offset> row{0};   ///< one more than these: where their weights begin
  std::vector<Index> column;    ///< q
  std::vector<double> weight;   ///< w, one per column
  std::vector<double> project;  ///< P, B * B per vector

  Index size() const { return static_cast<Index>(vector.size()); }
  bool operator==(const Jumps&) const = default;
};

/// x <- Z x, and back: B per vector of the whole problem.
template <int B>
void to_displacements(const Jumps<B>& jumps, std::vector<double>& x);
template <int B>
void to_jumps(const Jumps<B>& jumps, std::vector<double>& u);

/// Forces: b <- Z'b. Those on the slave's side stay what they are, the master's gets the counterforces.
template <int B>
void transform_forces(const Jumps<B>& jumps, std::vector<double>& b);

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

/// Interpolation between unknowns, Z_fine^-1 P Z_coarse. At slave vectors whose coarse ones are on the slave's side as
/// well it takes jumps to be interpolated from jumps alone, which leaves out by how much the master's displacements are
/// projected otherwise on the two meshes: then what is admissible below is so above.
template <int B>
Prolongation between_jumps(const Prolongation& prolongation, const Jumps<B>& fine, const Jumps<B>& coarse);

}  // namespace signorini
