#include "estimators/certificate/certificate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "estimators/certificate/balance.hpp"
#include "estimators/certificate/base_flux.hpp"
#include "estimators/certificate/contact_forces.hpp"
#include "estimators/certificate/energy.hpp"
#include "estimators/certificate/misfit.hpp"
#include "estimators/certificate/numbers.hpp"

namespace signorini {
namespace {

/// Of the largest force: what counts as equilibrium.
constexpr double balanced = 1e-9;

template <int D, int B>
class Certificate {
 public:
  Certificate(const Nodes<D>& nodes, const Model<B>& model, TrueProblem<D, B>& problem,
              const EstimateOptions<B>& options)
      : nodes_(nodes),
        model_(model),
        options_(options),
        problem_(problem),
        of_u_(problem_),
        better_(problem_, nodes.order()) {}

  Estimate compute() {
    if (!better_.possible) problem_.reasons.add("what is prescribed keeps the body from the right side between nodes");
    out_.lifted = lifted_.energy();
    out_.energy = deformation_energy(problem_, lifted_);
    out_.lower = better_.won;
    bound_from_above(better_.swept);
    out_.total = out_.energy - work_of_loads(problem_, lifted_) + friction_;
    gather_children(nodes_, out_.of_element);
    out_.guaranteed = problem_.reasons.none();
    out_.reasons = problem_.reasons.all;
    return std::move(out_);
  }

 private:
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
    out_.upper = out_.estimated = with_oscillation + parts.contact + parts.friction;
    out_.of_element = std::move(misfit);
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const EstimateOptions<B>& options_;
  TrueProblem<D, B>& problem_;
  const Bubbles<D, B> of_u_;
  const LiftedAndSwept<D, B> better_;
  const Bubbles<D, B>& lifted_ = better_.lifted;  // v
  double friction_ = 0;                           // its part of J(v)
  Estimate out_;
};

}  // namespace

template <int D, int B>
Estimate certificate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                     const EstimateOptions<B>& options) {
  std::vector<std::string> reasons = not_covered<D, B>(nodes, model, options);
  if (!reasons.empty()) return no_numbers(std::move(reasons));
  TrueProblem<D, B> problem(nodes, model, u, options.rest);
  if (problem.reasons.refused) return no_numbers(problem.reasons.all);
  return Certificate<D, B>(nodes, model, problem, options).compute();
}

template Estimate certificate(const Nodes<2>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate certificate(const Nodes<3>&, const Model<1>&, const std::vector<double>&, const EstimateOptions<1>&);
template Estimate certificate(const Nodes<2>&, const Model<2>&, const std::vector<double>&, const EstimateOptions<2>&);
template Estimate certificate(const Nodes<3>&, const Model<3>&, const std::vector<double>&, const EstimateOptions<3>&);

}  // namespace signorini
