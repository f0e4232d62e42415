#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "amg/coarsening/aggregates.hpp"
#include "core/algebra/near_null_space.hpp"
#include "core/solver/components.hpp"
#include "methods/configuration.hpp"

namespace signorini {

/// Levels below that of a problem, coarsest first, and their matrices, which serve all problems with the same matrix,
/// frames and prescribed components: see DiscreteProblem::galerkin.
template <int B>
struct AlgebraicLevels {
  std::vector<Prolongation> prolongations;
  std::vector<GalerkinMatrix<B>> matrices;  ///< one for each prolongation
};

/// On which coarsening ends.
inline constexpr Index enough_vectors = 400;

template <int B>
using TransferFactory = std::function<std::unique_ptr<Transfer<B>>()>;

/// Levels chosen by the matrix, until at most `enough` vectors are left or coarsening makes no progress. They continue
/// a geometric hierarchy downwards, or are a hierarchy of their own.
/// @param transfer makes the transfers whose Galerkin products the coarser levels are chosen by
/// @param near_null what coarser levels by aggregation represent exactly, on the level of `problem`
/// @param aggregator makes the aggregates of levels by aggregation
template <int B>
AlgebraicLevels<B> algebraic_hierarchy(const DiscreteProblem<B>& problem, const TransferFactory<B>& transfer,
                                       Index enough = enough_vectors, const AlgebraicSettings& settings = {},
                                       NearNullSpace near_null = {}, const Aggregator& aggregator = GreedyAggregator());

/// The matrices of given levels, whose interpolations are changed to what the settings want.
/// @param prolongations coarsest first; the last one leads to the level of `problem`
/// @param known these matrices, where they need not be computed, for interpolations that the settings leave as they are
///     and problems without frames and prescribed components
/// @throws Error(Exit::input) where a known matrix has an entry that the product has not
template <int B>
AlgebraicLevels<B> galerkin_hierarchy(const DiscreteProblem<B>& problem, std::vector<Prolongation> prolongations,
                                      const TransferFactory<B>& transfer, const AlgebraicSettings& settings = {},
                                      std::vector<BlockMatrix<B>> known = {});

}  // namespace signorini
