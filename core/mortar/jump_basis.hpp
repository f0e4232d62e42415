#pragma once
#include <span>

#include "core/algebra/block_matrix.hpp"
#include "core/mortar/couple.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Displacements of bodies in contact with each other, in one numbering, by jumps û at the slave nodes: u = Z û with
///
///     u_p = û_p + sum over q of M̂_pq û_q   at slave nodes p,   u = û elsewhere.
///
/// Not to overlap is a bound on û_p alone. No slave node is a master node, so that Z⁻¹ is Z with −M̂.
struct JumpBasis {
  std::vector<Offset> row{0};  ///< per vector; rows of M̂, empty where there is no slave node
  std::vector<Index> column;
  std::vector<double> weight;  ///< one number for all components

  Index vectors() const { return static_cast<Index>(row.size()) - 1; }
  bool jumps(Index p) const { return row[p] < row[p + 1]; }
};

/// The basis of several couplings of bodies in one numbering.
/// Error(Exit::input) naming `place` and the node where one is a slave node twice, or a slave node of one coupling and
/// a master node of another: then the bounds are not those of single vectors.
/// @param vectors number of nodes of all bodies
template <int D>
JumpBasis jump_basis(Index vectors, std::span<const MortarCoupling<D>> couplings, std::string_view place);

/// x = Z x; B components per vector.
template <int B>
void from_jumps(const JumpBasis& Z, double* x);
/// x = Z⁻¹ x
template <int B>
void to_jumps(const JumpBasis& Z, double* x);
/// r = Z'r: forces on displacements become those on jumps.
template <int B>
void forces_to_jumps(const JumpBasis& Z, double* r);

/// Z'AZ
template <int B>
BlockMatrix<B> matrix_of_jumps(const BlockMatrix<B>& A, const JumpBasis& Z);

/// Z⁻¹ P Z_c: the interpolation between jumps on two meshes of the same bodies. Entries that vanish but for rounding
/// are left out. Twins are those of P.
/// @param Z on the fine mesh
/// @param P scalar weights
/// @param coarse Z_c
Prolongation prolongation_of_jumps(const JumpBasis& Z, const Prolongation& P, const JumpBasis& coarse);

}  // namespace signorini
