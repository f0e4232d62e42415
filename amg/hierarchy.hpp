#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "amg/near_null_space.hpp"
#include "core/solver/components.hpp"
#include "core/solver/configuration.hpp"

namespace signorini {

/// Levels below that of a problem, coarsest first, and their matrices, which serve all problems with the same matrix,
/// frames and prescribed components: see DiscreteProblem::galerkin.
template <int B>
struct AlgebraicLevels {
  std::vector<Prolongation> prolongations;
  std::vector<GalerkinMatrix<B>> matrices;  ///< one for each prolongation
};

template <int B>
using TransferFactory = std::function<std::unique_ptr<Transfer<B>>()>;

/// What the coarsest level may have.
inline constexpr Index few_vectors = 400;

/// Levels chosen by the matrix, until at most `enough` vectors are left or coarsening makes no progress. They continue
/// a geometric hierarchy downwards, or are a hierarchy of their own.
/// @param transfer makes the transfers whose Galerkin products the coarser levels are chosen by
/// @param near_null what coarser levels by aggregation represent exactly, on the level of `problem`
template <int B>
AlgebraicLevels<B> algebraic_hierarchy(const DiscreteProblem<B>& problem, const TransferFactory<B>& transfer,
                                       Index enough = few_vectors, Coarsening coarsening = Coarsening::classical,
                                       NearNullSpace near_null = {});

/// The matrices of given levels.
/// @param prolongations coarsest first; the last one leads to the level of `problem`
template <int B>
AlgebraicLevels<B> galerkin_hierarchy(const DiscreteProblem<B>& problem, std::vector<Prolongation> prolongations,
                                      const TransferFactory<B>& transfer);

}  // namespace signorini
