#include "estimators/certificate/hierarchical.hpp"

#include <numeric>

#include "estimators/certificate/certificate.hpp"
#include "estimators/certificate/energy.hpp"
#include "estimators/certificate/numbers.hpp"

namespace signorini {
namespace {

/// The energy of what is between two functions, in each element.
template <int D, int B>
std::vector<double> energies_between(const TrueProblem<D, B>& problem, const Bubbles<D, B>& v, const Bubbles<D, B>& w) {
  std::vector<double> out;
  for (Index e = 0; e < problem.elements(); ++e) {
    auto between = v.gradients(e);
    const auto of_w = w.gradients(e);
    for (int x = 0; x <= D; ++x) add(-1, of_w[x], between[x]);
    out.push_back(deformation_energy<D, B>(problem, e, between));
  }
  return out;
}

}  // namespace

template <int D, int B>
Estimate hierarchical(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                      const EstimateOptions<B>& options) {
  std::vector<std::string> reasons = not_covered<D, B>(nodes, model, options);
  if (!reasons.empty()) return no_numbers(std::move(reasons));
  const TrueProblem<D, B> problem(nodes, model, u, options.rest);
  if (problem.reasons.refused) return no_numbers(problem.reasons.all);
  const LiftedAndSwept<D, B> of_u(problem, nodes.order());
  Estimate out = no_numbers({"an estimate, no bound"});
  out.lifted = of_u.lifted.energy();
  out.energy = deformation_energy(problem, of_u.lifted);
  out.estimated = of_u.won;
  out.of_element = energies_between(problem, of_u.swept, of_u.lifted);
  const double all = std::accumulate(out.of_element.begin(), out.of_element.end(), 0.0);
  for (double& share : out.of_element) share *= all > 0 ? out.estimated / all : 0;
  gather_children(nodes, out.of_element);
  return out;
}

template Estimate hierarchical(const Nodes<2>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate hierarchical(const Nodes<3>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate hierarchical(const Nodes<2>&, const Model<2>&, const std::vector<double>&, const EstimateOptions<2>&);
template Estimate hierarchical(const Nodes<3>&, const Model<3>&, const std::vector<double>&, const EstimateOptions<3>&);

}  // namespace signorini
