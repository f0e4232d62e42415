#pragma once
#include "estimators/certificate/bubbles.hpp"

namespace signorini {

/// Coefficients, at vertices and edges, of the distance of v from one of the bounds of an obstacle.
template <int D, int B>
class Bounded {
 public:
  /// Keeps references.
  Bounded(const TrueProblem<D, B>& problem, const Gaps<D, B>& gaps, const Bubbles<D, B>& bubbles)
      : problem_(problem), gaps_(gaps), bubbles_(bubbles) {}

  double at_vertex(Index p, bool upper) const { return distances(problem_, gaps_, p)[upper]; }
  double at_edge(Index e, bool upper) const {
    const auto* bound = gaps_.at_edge(e);
    if (!bound) return 0;
    double c = 0;
    for (int i = 0; i < B; ++i) c += bound->direction[i] * bubbles_.coefficients()[Offset{e} * B + i];
    return upper ? bound->upper - c : c - bound->lower;
  }
  /// Over an element, with the mean 4 / ((D + 1) (D + 2)) of a bubble.
  double mean(Index e, bool upper) const {
    double sum = 0;
    constexpr int edges = Incidence<D>::edges_per_element;
    for (const Index p : problem_.mesh.elements[e]) sum += at_vertex(p, upper) / (D + 1);
    for (int k = 0; k < edges; ++k)
      sum += at_edge(problem_.incidence.edge[Offset{e} * edges + k], upper) * 4 / ((D + 1) * (D + 2));
    return sum;
  }

 private:
  const TrueProblem<D, B>& problem_;
  const Gaps<D, B>& gaps_;
  const Bubbles<D, B>& bubbles_;
};

/// Of a linear function times a quadratic one, over the measure: by values at vertices, and coefficients of bubbles.
template <int D>
double integral_over_face(const std::array<double, D>& p, const std::array<double, D>& vertex,
                          const std::array<double, D*(D - 1) / 2>& edge) {
  constexpr auto ends = simplex_edges<D - 1>();
  double sum = 0, of_p = 0;
  for (const double v : p) of_p += v;
  for (int k = 0; k < D; ++k) sum += (of_p + p[k]) * vertex[k] / (D * (D + 1));
  for (std::size_t k = 0; k < ends.size(); ++k)
    sum += 4 * (of_p + p[ends[k][0]] + p[ends[k][1]]) * edge[k] / (D * (D + 1) * (D + 2));
  return sum;
}

/// What a linear pressure does on the way to the obstacle.
template <int D, int B>
double work_on_face(const TrueProblem<D, B>& problem, const OuterFace<D, B>& outer, const std::array<Index, D>& v,
                    const std::array<double, D>& p, const Bounded<D, B>& distance) {
  const auto edges = edges_of_face(problem.mesh, problem.incidence, outer.face);
  double work = 0;
  for (const bool upper : {false, true}) {
    std::array<double, D> pushes, vertex;
    for (int k = 0; k < D; ++k) pushes[k] = std::max(0.0, upper ? -p[k] : p[k]);
    if (std::ranges::all_of(pushes, [](double push) { return push == 0; })) continue;
    for (int k = 0; k < D; ++k) vertex[k] = distance.at_vertex(v[k], upper);
    std::array<double, D*(D - 1) / 2> edge{};
    for (std::size_t k = 0; k < edge.size(); ++k) edge[k] = distance.at_edge(edges[k], upper);
    work += length<D>(outer.normal) * integral_over_face<D>(pushes, vertex, edge);
  }
  return work;
}

}  // namespace signorini
