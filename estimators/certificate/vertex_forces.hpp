#pragma once
#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/small_solve.hpp"

namespace signorini {

/// At the vertices: what is left of the loads, and how stiff the body is there.
template <int D, int B>
struct AtVertices {
  std::vector<std::array<double, B>> residual;
  std::vector<std::array<double, B * B>> stiffness;
  std::vector<FixedDirections<B>> fixed;

  explicit AtVertices(const TrueProblem<D, B>& problem);

  /// What moving a vertex along a direction costs, per square of the way.
  double stiffness_along(Index p, const std::array<double, B>& n) const {
    double sum = 0;
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) sum += n[i] * stiffness[p][i * B + j] * n[j];
    return sum;
  }
};

/// What obstacles exert along their directions, per obstacle and vertex, positive from the lower bound: what together
/// is next to the residual, of those that push more than the way to their bound would cost, as active sets decide.
template <int D, int B>
std::vector<std::vector<double>> forces_at_vertices(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at);

}  // namespace signorini
