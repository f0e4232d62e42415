#pragma once
#include "estimators/certificate/bubbles.hpp"

/// The parts of J(v) = 1/2 a(v, v) - f(v) for a function v with bubbles. Friction has a part of its own.
namespace signorini {

/// 1/2 a(v, v) in an element where v has the gradient sum over x of phi_x gradients[x], with
/// int phi_x phi_y = |T| (1 + [x = y]) / ((D + 1) (D + 2)).
template <int D, int B>
double deformation_energy(const TrueProblem<D, B>& problem, Index e,
                          const std::array<Gradient<D, B>, D + 1>& gradients) {
  Gradient<D, B> sum{};
  double squares = 0;
  for (const auto& g : gradients) {
    add(1, g, sum);
    squares += contract(g, flux(problem.material[e], g));
  }
  squares += contract(sum, flux(problem.material[e], sum));
  return problem.element[e].measure / (2 * (D + 1) * (D + 2)) * squares;
}

template <int D, int B>
double deformation_energy(const TrueProblem<D, B>& problem, const Bubbles<D, B>& v) {
  double energy = 0;
  for (Index e = 0; e < problem.elements(); ++e) energy += deformation_energy<D, B>(problem, e, v.gradients(e));
  return energy;
}

/// f(v)
template <int D, int B>
double work_of_loads(const TrueProblem<D, B>& problem, const Bubbles<D, B>& v) {
  const auto at = [](const std::vector<double>& of, Index k) { return of.data() + Offset{k} * B; };
  const auto product = [](const std::array<double, B>& load, const double* value) {
    double sum = 0;
    for (int i = 0; i < B; ++i) sum += load[i] * value[i];
    return sum;
  };
  double work = 0;
  for (Index e = 0; e < problem.elements(); ++e)
    for (int a = 0; a <= D; ++a) work += product(problem.moment(e, a), at(v.at_vertex(), problem.mesh.elements[e][a]));
  for (const OuterFace<D, B>& outer : problem.outer) {
    const auto vertices = face_vertices<D>(problem.mesh, problem.incidence.sides[outer.face]);
    for (int k = 0; k < D; ++k) work += product(outer.load[k], at(v.at_vertex(), vertices[k]));
  }
  for (Index e = 0; e < problem.incidence.edges; ++e) work += product(problem.edge_load[e], at(v.coefficients(), e));
  return work;
}

}  // namespace signorini
