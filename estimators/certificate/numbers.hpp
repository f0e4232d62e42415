#pragma once
#include <limits>
#include <string>
#include <vector>

#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/certificate.hpp"
#include "estimators/certificate/quadratic_function.hpp"

/// What the certificate and the hierarchical estimator have in common.
namespace signorini {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

inline Estimate no_numbers(std::vector<std::string> reasons) {
  Estimate none;
  none.lower = none.upper = none.estimated = none.total = none.lifted = none.energy = not_known;
  none.parts = {not_known, not_known, not_known, not_known, not_known, not_known};
  none.reasons = std::move(reasons);
  return none;
}

template <int D, int B>
std::vector<std::string> not_covered(const Nodes<D>& nodes, const Model<B>& model, const EstimateOptions<B>& options) {
  std::vector<std::string> reasons = not_certified<D, B>(nodes, model);
  if (options.paired_anew)
    reasons.emplace_back("bodies that load steps have moved past each other or past an obstacle are not covered");
  return reasons;
}

/// Sweeps over the bubbles, for the bound from below: in the plane one wins 0.4 to 0.9 of the energy that is there,
/// three 0.75 to 1; in space two take a quarter more time than one. Of quadratic elements one wins too little.
constexpr int sweeps(int dimension, int order) { return dimension == 2 || order == 2 ? 3 : 1; }

/// A solution that is admissible between nodes, and one that bubbles have made better.
template <int D, int B>
struct LiftedAndSwept {
  LiftedAndSwept(const TrueProblem<D, B>& problem, int order)
      : lifted(problem), possible(lifted.lift()), swept([&] {
          if (lifted.lifted()) lifted.sweep(true);
          return lifted;
        }()) {
    for (int k = 0; k < sweeps(D, order); ++k) won += swept.sweep();
  }

  Bubbles<D, B> lifted;
  bool possible;  ///< what is prescribed allows to lift it
  Bubbles<D, B> swept;
  double won = 0;  ///< energy, by sweeps
};

/// Quadratic elements have the shares of their children.
template <int D>
void gather_children(const Nodes<D>& nodes, std::vector<double>& of_element) {
  if (nodes.order() == 1) return;
  std::vector<double> of_father(nodes.mesh().families.size());
  const std::vector<Index> father = fathers(nodes);
  for (std::size_t e = 0; e < father.size(); ++e) of_father[father[e]] += of_element[e];
  of_element = std::move(of_father);
}

}  // namespace signorini
