#pragma once
#include <functional>
#include <vector>

#include "estimators/certificate/flux.hpp"
#include "estimators/certificate/true_problem.hpp"

namespace signorini {

/// Numbers of the normal flux through each face, out of its first element: D * B per face, B for each of its vertices.
/// Moments are its integrals times hat functions; values those at the vertices times the measure of the face.
using FaceNumbers = std::vector<double>;

template <int D, int B>
double* at(FaceNumbers& numbers, Index face, int k) {
  return numbers.data() + (Offset{face} * D + k) * B;
}
template <int D, int B>
const double* at(const FaceNumbers& numbers, Index face, int k) {
  return numbers.data() + (Offset{face} * D + k) * B;
}

/// A flux that is linear in each element, by its values at the vertices there.
template <int D, int B>
using ElementFlux = std::function<std::array<Gradient<D, B>, D + 1>(Index element)>;

/// What obstacles exert.
template <int D, int B>
struct ContactForces {
  std::vector<double> in_element;  ///< D + 1 per element: shares of the forces of its vertices; empty: none
  std::vector<std::array<std::array<double, B>, D>> on_face;  ///< per outer face: moments; empty: none
};

/// Moments of a flux in equilibrium with loads and contact: for each element T and vertex i of it, with the flux s that
/// they are near to,
///     sum over faces F of T at i of +-m_{F,i} = int_T s . grad phi_i - int_T f phi_i - contact_{T,i}.
/// Where the flux is given they are what is given. Vertex by vertex the sum of |m - m(s)|^2 / |F| is least: a graph
/// Laplacian of the elements around it (Ladeveze and Leguillon 1983; Ainsworth and Oden 2000, ch. 6). What nothing
/// there can carry, the residual of s at the vertex, is divided among its elements.
template <int D, int B>
FaceNumbers equilibrated_moments(const TrueProblem<D, B>& problem, const ElementFlux<D, B>& flux,
                                 const ContactForces<D, B>& contact);

/// Values from moments, in place: the inverse of the faces' mass matrix, times the measure.
template <int D, int B>
void moments_to_values(FaceNumbers& numbers);

/// int_T s . grad phi_i - int_T f phi_i - contact_{T,i}, for the vertices of an element.
template <int D, int B>
std::array<std::array<double, B>, D + 1> element_residuals(const TrueProblem<D, B>& problem, Index e,
                                                           const std::array<Gradient<D, B>, D + 1>& flux,
                                                           const ContactForces<D, B>& contact) {
  Gradient<D, B> mean{};
  for (const auto& s : flux) add(problem.element[e].measure / (D + 1), s, mean);
  std::array<std::array<double, B>, D + 1> out;
  for (int a = 0; a <= D; ++a) {
    out[a] = applied(mean, problem.element[e].gradient[a]);
    const auto source = problem.moment(e, a);
    for (int i = 0; i < B; ++i) out[a][i] -= source[i];
    if (!contact.in_element.empty()) out[a][0] -= contact.in_element[Offset{e} * (D + 1) + a];
  }
  return out;
}

}  // namespace signorini
