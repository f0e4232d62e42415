#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/component/registry.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/solver/discrete_problem.hpp"
#include "estimators/estimate.hpp"

namespace signorini {

/// Solves A x = b of a problem without obstacles, whose prescribed values are zero, roughly: to a residual of
/// about 1e-4. False: it could not.
template <int B>
using LinearSolve = std::function<bool(const DiscreteProblem<B>& problem, std::vector<double>& x)>;

template <int B>
struct EstimateOptions {
  LinearSolve<B> solve;        ///< for a sharper bound of elastic bodies; none: they do without
  double algebraic_error = 0;  ///< of the solution, relative, in the energy norm: for parts.algebra alone
  std::vector<double> rest{};  ///< where friction holds back nothing, as u; empty: at zero
  bool paired_anew = false;    ///< faces of bodies find each other where load steps have moved them
  OwnPressure<B> pressure{};   ///< of an elastic body
};

/// How far a discrete solution is from the solution of its model. D is the dimension of the mesh, B the components of
/// the unknown: (2, 1), (3, 1), (2, 2) or (3, 3).
template <int D, int B>
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// @param u the discrete solution in global coordinates, B numbers per node
  /// What it does not cover is said in Estimate::reasons; where it has no numbers then, they are not finite.
  virtual Estimate estimate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                            const EstimateOptions<B>& options) const = 0;
};

/// The estimator of this id: one of plugins knows stresses alone, see ErrorEstimator, and has no bounds.
/// Errors: Error(Exit::input) for an id that is not registered, Error(Exit::plugin) from plugins.
template <int D, int B>
std::unique_ptr<Estimator<D, B>> create_estimator(const Registry& registry, const std::string& id);

}  // namespace signorini
