#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "core/solver/discrete_problem.hpp"

/// What rounding leaves of the accuracy of a solution, however long one iterates: residuals are known to about
/// epsilon (|A||x| + |b|) only, and forces of that size move what has little energy far.
namespace signorini {

/// Errors by rounding from which on nothing is claimed.
inline constexpr double inaccurate = 1e-2;

/// About ||d||_A for A d = forces on the free components alone, the better the larger it is beside `enough`; nothing
/// where that is not known.
using Response = std::function<std::optional<double>(const std::vector<double>& forces, double enough)>;

/// A bound of the error by rounding, without any solve: by the energy of x and of the last step beside that of rough
/// vectors. Far too large in most cases, too small where loads and steps avoid what has the least energy.
/// @param before the iterate before the last step
/// @param xAx of the free components
/// @param stepAstep of the last step
template <int B>
double rough_rounding_error(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                            const std::vector<double>& before, double xAx, double stepAstep);

/// The error by rounding in the energy norm: what random errors of the forces do.
/// @param enough smaller errors need not be known exactly
template <int B>
double rounding_error(const DiscreteProblem<B>& problem, const std::vector<double>& x, double enough,
                      const Response& response);

/// Forces on the free components of a body that moves without any energy that rounding would show, all of them in the
/// norm of the inverse diagonal: what there is to compare with instead.
struct Balance {
  double acting;    ///< loads, and forces of obstacles that rounding does not explain
  double resting;   ///< what is left of them where nothing holds
  double rounding;  ///< epsilon (|A||x| + |b|)
};
/// @param r b - A x
template <int B>
Balance balance(const DiscreteProblem<B>& problem, const std::vector<double>& x, const std::vector<double>& r);

}  // namespace signorini
