#include "estimators/certificate/certificate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "estimators/certificate/balance.hpp"
#include "estimators/certificate/base_flux.hpp"
#include "estimators/certificate/contact_forces.hpp"
#include "estimators/certificate/energy.hpp"
#include "estimators/certificate/misfit.hpp"

namespace signorini {
namespace {

/// Of the largest force: what counts as equilibrium.
constexpr double balanced = 1e-9;

/// Sweeps over the bubbles, for the bound from below: in the plane one wins 0.4 to 0.9 of the energy that is there,
/// three 0.75 to 1; in space two take a quarter more time than one. Of quadratic elements one wins too little.
constexpr int sweeps(int dimension, int order) { return dimension == 2 || order == 2 ? 3 : 1; }

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

Estimate no_numbers(std::vector<std::string> reasons) {
  Estimate none;
  none.lower = none.upper = none.total = none.lifted = none.energy = not_known;
  none.parts = {not_known, not_known, not_known, not_known, not_known, not_known};
  none.reasons = std::move(reasons);
  return none;
}

template <int D, int B>
class Certificate {
 public:
  Certificate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
              const EstimateOptions<B>& options)
      : nodes_(nodes),
        model_(model),
        options_(options),
        problem_(nodes, model, u, options.rest),
        of_u_(problem_),
        lifted_(of_u_) {}

  Estimate compute() {
    if (problem_.reasons.refused) return no_numbers(problem_.reasons.all);
    if (!lifted_.lift()) problem_.reasons.add("what is prescribed keeps the body from the right side between nodes");
    if (lifted_.lifted()) lifted_.sweep(true);
    out_.lifted = lifted_.energy();
    out_.energy = deformation_energy(problem_, lifted_);
    Bubbles<D, B> swept = lifted_;
    for (int k = 0; k < sweeps(D, nodes_.order()); ++k) out_.lower += swept.sweep();
    bound_from_above(swept);
    out_.total = out_.energy - work_of_loads(problem_, lifted_) + friction_;
    if (nodes_.order() > 1) gather_children();
    out_.guaranteed = problem_.reasons.none();
    out_.reasons = problem_.reasons.all;
    return std::move(out_);
  }

 private:
  /// Quadratic elements have the shares of their children.
  void gather_children() {
    std::vector<double> of_father(nodes_.mesh().families.size());
    const std::vector<Index> father = fathers(nodes_);
    for (std::size_t e = 0; e < father.size(); ++e) of_father[father[e]] += out_.of_element[e];
    out_.of_element = std::move(of_father);
  }

  ElementFlux<D, B> flux_of(const Bubbles<D, B>& v) const {
    return [&](Index e) {
      std::array<Gradient<D, B>, D + 1> out = v.gradients(e);
      for (auto& g : out) g = flux(problem_.material[e], g);
      return out;
    };
  }

  /// Moments of a flux in equilibrium, near that of u, or of what is better than that.
  FaceNumbers moments(const Bubbles<D, B>& swept, const ContactForces<D, B>& contact) {
    if (!options_.solve) return equilibrated_moments<D, B>(problem_, flux_of(of_u_), contact);
    BaseFlux<D, B> base(problem_, model_, swept);
    out_.solve_failed = !base.correct(contact, options_.solve);
    return equilibrated_moments<D, B>(
        problem_, [&](Index e) { return base(e); }, contact);
  }

  void bound_from_above(const Bubbles<D, B>& swept) {
    const Contact<D, B> contact = contact_of(problem_, lifted_);
    if (contact.computed_constant)
      problem_.reasons.add(
          "pressures between bodies whose meshes do not match are bounded by a computed constant, which "
          "is not proven");
    FaceNumbers values = moments(swept, contact.forces);
    moments_to_values<D, B>(values);
    if constexpr (B == D) balance_whole(problem_, contact.forces, values);
    balance_along_tree(problem_, contact.forces, values);
    const ElementFlux<D, B> of_v = flux_of(lifted_);
    constexpr int steps = 2;
    std::vector<double> misfit = reduce_misfit(problem_, Misfit<D, B>(problem_, of_v), steps, values);
    add_up(std::move(misfit), contact);
    out_.imbalance = largest_imbalance(problem_, contact.forces, values);
    if (!(out_.imbalance <= balanced))
      problem_.reasons.add(fmt::format("forces of {:.1g} of the largest one remain without balance", out_.imbalance));
  }

  /// 1/2 sum of (d_T + osc_T)^2 with d_T^2 / 2 the misfit: what a load does whose mean over the element is zero.
  void add_up(std::vector<double> misfit, const Contact<D, B>& contact) {
    double of_misfit = 0, with_oscillation = 0;
    for (std::size_t e = 0; e < misfit.size(); ++e) {
      double oscillation = problem_.oscillation.empty() ? 0 : problem_.oscillation[e];
      if (!contact.oscillation.empty()) oscillation += contact.oscillation[e];
      const double d = std::sqrt(2 * std::max(0.0, misfit[e])) + oscillation;
      of_misfit += misfit[e];
      with_oscillation += d * d / 2;
      misfit[e] = d * d / 2 + contact.work[e];
    }
    EstimateParts& parts = out_.parts;
    if (problem_.reasons.geometry_unknown) parts.geometry = not_known;
    parts.friction = contact.friction;
    friction_ = contact.friction_energy;
    parts.contact = std::max(0.0, std::accumulate(contact.work.begin(), contact.work.end(), 0.0) - contact.friction);
    parts.oscillation = with_oscillation - of_misfit;
    parts.algebra = std::min(of_misfit, options_.algebraic_error * options_.algebraic_error * out_.energy);
    parts.discretisation = of_misfit - parts.algebra;
    out_.upper = with_oscillation + parts.contact + parts.friction;
    out_.of_element = std::move(misfit);
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const EstimateOptions<B>& options_;
  TrueProblem<D, B> problem_;
  const Bubbles<D, B> of_u_;
  Bubbles<D, B> lifted_;  // v
  double friction_ = 0;   // its part of J(v)
  Estimate out_;
};

}  // namespace

template <int D, int B>
Estimate certificate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                     const EstimateOptions<B>& options) {
  std::vector<std::string> reasons = not_certified<D, B>(nodes, model);
  if (options.paired_anew)
    reasons.emplace_back("bodies that load steps have moved past each other or past an obstacle are not covered");
  if (!reasons.empty()) return no_numbers(std::move(reasons));
  return Certificate<D, B>(nodes, model, u, options).compute();
}

template Estimate certificate(const Nodes<2>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate certificate(const Nodes<3>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate certificate(const Nodes<2>&, const Model<2>&, const std::vector<double>&, const EstimateOptions<2>&);
template Estimate certificate(const Nodes<3>&, const Model<3>&, const std::vector<double>&, const EstimateOptions<3>&);

}  // namespace signorini
