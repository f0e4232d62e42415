#pragma once
#include <functional>
#include <vector>

#include "core/algebra/block_matrix.hpp"

namespace signorini {

/// What conjugate gradients on the unmasked components found.
struct CgResult {
  int iterations = 0;
  bool converged = false;  ///< the residual was reduced as asked for, by a preconditioner that was positive definite
  bool singular = false;   ///< d ends in a direction without energy along which the functional falls: no minimum
};

/// Part of p'Dp, D the diagonal of A, up to which p'Ap is rounding.
inline constexpr double no_energy = 1e-13;

struct CgLimits {
  double reduction = 1e-8;  ///< of the preconditioned residual, at which to stop
  int iterations = 1000;
  double rounding = 0;  ///< a bound for what it may do to work along directions with entries up to one; 0: all counts
  double without_energy = no_energy;  ///< part of p'Dp up to which a direction of descent counts as one without minimum
  bool definite = false;  ///< known of A: all directions have energy, however little; ends where it is rounding
};

/// Preconditioner: z from r, both zero on masked components.
using Precondition = std::function<void(const std::vector<double>& r, std::vector<double>& z)>;

/// Conjugate gradients for A d = r on the components whose bit is not set in `mask` (per vector), from d = 0. A may be
/// semidefinite.
/// @param r on entry the right-hand side, zero on masked components; overwritten
template <int B>
CgResult masked_cg(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const Precondition& precondition,
                   const CgLimits& limits, std::vector<double>& r, std::vector<double>& d);

/// One symmetric Gauss-Seidel sweep for A x = b over the unmasked components.
template <int B>
void symmetric_gauss_seidel(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const std::vector<double>& b,
                            std::vector<double>& x);

/// Sets the masked components of v to zero.
template <int B>
void apply_mask(const std::vector<Flags>& mask, std::vector<double>& v);

}  // namespace signorini
