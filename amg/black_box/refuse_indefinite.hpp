#pragma once
#include "amg/coarsening/hierarchy.hpp"
#include "core/algebra/energy_along.hpp"

namespace signorini {

/// Of d'Ad, relative to d'Dd with the diagonal D of A.
inline constexpr double rounding_of_energy = 1e-12;

/// Error(Exit::input) where the energy along a direction is negative by more than rounding.
/// @param row of the direction's largest entry, for the message
void refuse_if_negative(const EnergyAlong& energy, Offset row);

/// What a factorisation may take without being seen beside a set-up, for a lower triangle with so many entries.
double affordable_operations(Offset entries);

/// Error(Exit::input) where a direction d with d'Ad < 0 is found, naming the row of its largest entry: by the smooth
/// directions of least energy, from the coarsest level upwards, and by a few conjugate gradient steps on every level,
/// which see the rough ones. This is a search, no proof.
/// @param A with a positive diagonal
template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels);

}  // namespace signorini
