#include "estimators/certificate/vertex_forces.hpp"

#include <cmath>

#include "estimators/certificate/face_moments.hpp"

namespace signorini {
namespace {

/// One side of an obstacle at a vertex.
template <int B>
struct Push {
  std::size_t obstacle;
  std::array<double, B> direction;  ///< as far as the vertex may move
  double sign, free, least;         ///< free: |direction|^2; least: what the way to the bound would cost
  double force = 0;
};

/// The forces >= 0 whose sum is next to the residual, by projected Gauss-Seidel.
template <int B>
void fit(const std::array<double, B>& residual, std::vector<Push<B>>& pushes) {
  constexpr int sweeps = 100;
  std::array<double, B> left = residual;
  for (Push<B>& push : pushes) push.force = 0;
  bool changed = true;
  for (int sweep = 0; sweep < sweeps && changed; ++sweep) {
    changed = false;
    for (Push<B>& push : pushes) {
      const double force = std::max(0.0, push.force + push.sign * dot(push.direction, left) / push.free);
      for (int i = 0; i < B; ++i) left[i] -= push.sign * (force - push.force) * push.direction[i];
      changed = changed || std::fabs(force - push.force) > same_value * force;
      push.force = force;
    }
  }
}

template <int D, int B>
std::vector<Push<B>> pushes_at(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at, Index p) {
  std::vector<Push<B>> out;
  for (std::size_t k = 0; k < problem.gaps.size(); ++k) {
    const auto* bound = problem.gaps[k].at_vertex(p);
    if (!bound) continue;
    std::array<double, B> n = bound->direction;
    project(at.fixed[p], n);
    const double free = dot(n, bound->direction), stiffness = at.stiffness_along(p, bound->direction);
    if (!(free > same_direction)) continue;
    const auto [below, above] = distances(problem, problem.gaps[k], p);
    if (std::isfinite(below)) out.push_back({k, n, 1, free, stiffness * below});
    if (std::isfinite(above)) out.push_back({k, n, -1, free, stiffness * above});
  }
  return out;
}

}  // namespace

template <int D, int B>
AtVertices<D, B>::AtVertices(const TrueProblem<D, B>& problem)
    : residual(problem.mesh.points.size()), stiffness(problem.mesh.points.size()), fixed(problem.mesh.points.size()) {
  const Bubbles<D, B> of_u(problem);
  for (Index e = 0; e < problem.elements(); ++e) {
    const Simplex<D>& v = problem.mesh.elements[e];
    const LinearElement<D>& element = problem.element[e];
    std::array<Gradient<D, B>, D + 1> s = of_u.gradients(e);
    for (auto& g : s) g = flux(problem.material[e], g);
    const auto of_element = element_residuals<D, B>(problem, e, s, {});
    for (int a = 0; a <= D; ++a) {
      const auto k = stiffness_of(problem.material[e], element.gradient[a], element.gradient[a]);
      for (int i = 0; i < B; ++i) residual[v[a]][i] += of_element[a][i];
      for (int i = 0; i < B * B; ++i) stiffness[v[a]][i] += element.measure * k[i];
    }
  }
  for (const OuterFace<D, B>& outer : problem.outer) {
    const auto v = face_vertices<D>(problem.mesh, problem.incidence.sides[outer.face]);
    for (int k = 0; k < D; ++k) {
      for (int i = 0; i < B; ++i) residual[v[k]][i] -= outer.load[k][i];
      for (int n = 0; n < outer.fixed.count; ++n) fixed[v[k]].add(outer.fixed.direction[n], 0, 0);
    }
  }
}

template <int D, int B>
std::vector<std::vector<double>> forces_at_vertices(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at) {
  std::vector<std::vector<double>> out(problem.gaps.size(), std::vector<double>(problem.mesh.points.size()));
  const auto too_far = [](const Push<B>& push) { return push.force > 0 && !(push.force > push.least); };
  for (Index p = 0; p < problem.mesh.vertices(); ++p) {
    std::vector<Push<B>> pushes = pushes_at(problem, at, p);
    for (bool all_push = pushes.empty(); !all_push;) {
      fit<B>(at.residual[p], pushes);
      all_push = std::erase_if(pushes, too_far) == 0;
    }
    for (const Push<B>& push : pushes) out[push.obstacle][p] += push.sign * push.force;
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template struct AtVertices<D, B>; \
  template std::vector<std::vector<double>> forces_at_vertices(const TrueProblem<D, B>&, const AtVertices<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
