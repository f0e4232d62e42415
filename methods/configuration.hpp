#pragma once
#include <span>

#include "core/component/registry.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/options.hpp"

namespace signorini {

enum class Method { automatic, monotone, tnnmg, pgs, pdas, newton };

/// How levels are chosen by the matrix: by interpolation from some of the vectors, or by smoothed aggregation.
enum class Coarsening {
  automatic,  ///< aggregation where a near null space is known, else classical
  classical,
  aggregation
};

/// Error(Exit::input) naming the option, what was found and what was expected where options are out of range or
/// contradict each other.
Method check_options(const SolverOptions& options);
/// The same for names of components that are not registered.
void check_components(const SolverOptions& options, const Registry& registry);
Coarsening coarsening_of(const SolverOptions& options);

/// Which interpolations algebraic levels get.
struct AlgebraicSettings {
  bool only_twins = false;  ///< constrained vectors from coarse twins of such alone; else what reaches them has bounds
  bool local = false;       ///< of local components; else of global ones
  Coarsening coarsening = Coarsening::automatic;
  bool stretched = false;  ///< cells are: aggregates are made of couplings that are strong at both their ends
};

/// What the options say about algebraic levels. Error(Exit::input) as above.
AlgebraicSettings algebraic_settings(const SolverOptions& options);

/// What the options say about the cycles. Error(Exit::input) as above, also for components that do not exist.
template <int B>
typename MonotoneMultigrid<B>::Settings settings_of(const SolverOptions& options);
template <int B>
Components<B> components_of(const SolverOptions& options, const Registry& registry);

}  // namespace signorini
