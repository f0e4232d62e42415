#include <utility>

#include "estimators/certificate/free_changes.hpp"

namespace signorini {
namespace {

/// The fluxes around what two faces of an element share: out of the one opposite to a, in through that opposite to b.
/// Around it all elements agree: the sign is that of the permutation (vertices shared, by number; a, b).
template <int D>
class Circulations {
 public:
  explicit Circulations(const TrueProblem<D, 1>& problem)
      : problem_(problem), closed_(static_cast<std::size_t>(count()), true) {
    each([&](Index kernel, Index e, int a, int b, double) {
      for (const int k : {a, b}) {
        const Index face = problem_.incidence.face[Offset{e} * (D + 1) + k];
        if (const Index outer = problem_.outer_of_face[face]; outer >= 0 && !problem_.outer[outer].held())
          closed_[kernel] = false;
      }
    });
  }

  Index count() const { return D == 2 ? problem_.mesh.vertices() : problem_.incidence.edges; }
  bool closed(Index kernel) const { return closed_[kernel]; }

  template <class Use>
  void each(const Use& use) const {
    constexpr auto pairs = simplex_edges<D>();
    for (Index e = 0; e < problem_.elements(); ++e) {
      const auto rank = ranks<D>(problem_.mesh.elements[e]);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [a, b] = pairs[k];
        if constexpr (D == 2) {
          const int c = 3 - a - b;
          use(problem_.mesh.elements[e][c], e, a, b, c == 1 ? -1.0 : 1.0);
        } else {  // the opposite edge; its ends c < d: (c, d, a, b) is even but for (02, 13)
          const std::size_t other = pairs.size() - 1 - k;
          const auto [c, d] = pairs[other];
          const bool odd = k == 1 || k == 4;
          use(problem_.incidence.edge[static_cast<std::size_t>(e) * pairs.size() + other], e, a, b,
              odd != (rank[c] > rank[d]) ? -1.0 : 1.0);
        }
      }
    }
  }

 private:
  const TrueProblem<D, 1>& problem_;
  std::vector<bool> closed_;
};

/// Adds linear fluxes through each face whose total is zero: +1 at a vertex of it and -1 at another one make the flux
/// (x_a + x_b - 2 x_k) / (D |T|) at both together, x_k opposite to the face.
template <int D>
void add_across_faces(const TrueProblem<D, 1>& problem, const FaceNumbers& gradient, FaceNumbers& z) {
  for (Index face = 0; face < problem.incidence.faces(); ++face) {
    const auto& sides = problem.incidence.sides[face];
    if (sides.outer() && !problem.outer[problem.outer_of_face[face]].held()) continue;
    double weight = 0;
    for (int side = 0; side < (sides.outer() ? 1 : 2); ++side) {
      const Index e = sides.element[side];
      const Simplex<D>& v = problem.mesh.elements[e];
      double squares = 0;
      for (const Index p : v) {
        const Point<D> way = difference<D>(problem.mesh.points[p], problem.mesh.points[v[sides.opposite[side]]]);
        squares += dot(way, way) / D;
      }
      weight += squares / ((D + 1) * (D + 2) * D * D * problem.element[e].measure * problem.material[e].diffusion);
    }
    double mean = 0;
    for (int k = 0; k < D; ++k) mean += *at<D, 1>(gradient, face, k) / D;
    for (int k = 0; k < D; ++k) *at<D, 1>(z, face, k) += (*at<D, 1>(gradient, face, k) - mean) / weight;
  }
}

}  // namespace

template <int D>
void around_edges(const TrueProblem<D, 1>& problem, const FaceNumbers& gradient, FaceNumbers& z) {
  const Circulations<D> around(problem);
  std::vector<double> slope(static_cast<std::size_t>(around.count())), energy(slope.size());
  const auto first = [&](Index e, int k) {
    const Index face = problem.incidence.face[Offset{e} * (D + 1) + k];
    return problem.incidence.sides[face].element[0] == e ? face : -1;
  };
  const auto sum = [&](Index face) {
    double g = 0;
    for (int m = 0; face >= 0 && m < D; ++m) g += *at<D, 1>(gradient, face, m);
    return g;
  };
  around.each([&](Index kernel, Index e, int a, int b, double sign) {
    const Simplex<D>& v = problem.mesh.elements[e];
    const Point<D> way = difference<D>(problem.mesh.points[v[b]], problem.mesh.points[v[a]]);
    slope[kernel] += sign * (sum(first(e, a)) - sum(first(e, b)));
    energy[kernel] += dot(way, way) / (D * D * problem.element[e].measure * problem.material[e].diffusion);
  });
  z.assign(gradient.size(), 0);
  around.each([&](Index kernel, Index e, int a, int b, double sign) {
    if (!around.closed(kernel)) return;
    const double by = sign * slope[kernel] / energy[kernel];
    for (const auto& [k, part] : {std::pair{a, by}, std::pair{b, -by}})
      if (const Index face = first(e, k); face >= 0)
        for (int m = 0; m < D; ++m) *at<D, 1>(z, face, m) += part;
  });
  add_across_faces(problem, gradient, z);
}

template void around_edges(const TrueProblem<2, 1>&, const FaceNumbers&, FaceNumbers&);
template void around_edges(const TrueProblem<3, 1>&, const FaceNumbers&, FaceNumbers&);

}  // namespace signorini
