#include "estimators/certificate/bubbles.hpp"

#include <algorithm>
#include <cmath>

#include "estimators/certificate/small_solve.hpp"

namespace signorini {

template <int D, int B>
Bubbles<D, B>::Bubbles(const TrueProblem<D, B>& problem)
    : problem_(problem),
      any_(!problem.u.of_edge.empty()),
      c_(problem.u.of_edge),
      lifted_(static_cast<std::size_t>(problem.incidence.edges)) {
  c_.resize(lifted_.size() * B);
}

template <int D, int B>
std::array<Index, 2> Bubbles<D, B>::ends(Index edge) const {
  constexpr auto local = simplex_edges<D>();
  const Index at = problem_.incidence.at_edge[problem_.incidence.first_at_edge[edge]];
  const Simplex<D>& v = problem_.mesh.elements[at / Index{local.size()}];
  const auto [a, b] = local[at % Index{local.size()}];
  return {v[a], v[b]};
}

/// Of `direction . c`: see Gaps.
template <int D, int B>
std::array<double, 2> Bubbles<D, B>::range(Index edge, Index a, Index b) const {
  const auto* bound = problem_.gaps.at_edge(edge);
  const auto from = distances(problem_, a), to = distances(problem_, b);
  const double lower = bound->lower - (from[0] + to[0]) / 4, upper = bound->upper + (from[1] + to[1]) / 4;
  return {std::isnan(lower) ? -infinity : lower, std::isnan(upper) ? infinity : upper};
}

template <int D, int B>
bool Bubbles<D, B>::lift() {
  bool possible = true;
  for (Index e = 0; e < problem_.incidence.edges && problem_.gaps.any(); ++e) {
    const auto* bound = problem_.gaps.at_edge(e);
    if (!bound) continue;
    const auto [a, b] = ends(e);
    const auto [lower, upper] = range(e, a, b);
    double there = 0;
    for (int i = 0; i < B; ++i) there += bound->direction[i] * c_[Offset{e} * B + i];
    const double by = std::clamp(there, std::min(lower, upper), std::max(lower, upper)) - there;
    if (std::fabs(by) <= problem_.gaps.rounding) continue;
    std::array<double, B> n = bound->direction;
    if (problem_.edge_fix[e] >= 0) project(problem_.edge_fixes[problem_.edge_fix[e]], n);
    const double along = dot(n, bound->direction);
    if (!(along > same_direction) || lower > upper) {
      possible = false;
      continue;
    }
    for (int i = 0; i < B; ++i) c_[Offset{e} * B + i] += n[i] * by / along;
    lifted_[e] = any_lifted_ = any_ = true;
  }
  return possible;
}

/// H_x with the gradient sum over x of phi_x H_x: b_xy = 4 phi_x phi_y adds 4 c (x) grad phi_y to H_x.
template <int D, int B>
std::array<Gradient<D, B>, D + 1> Bubbles<D, B>::gradients(Index e) const {
  constexpr auto local = simplex_edges<D>();
  const auto& g = problem_.element[e].gradient;
  std::array<Gradient<D, B>, D + 1> out;
  out.fill(gradient<D, B>(g, problem_.mesh.elements[e], problem_.u.at_vertex));
  if (!any_) return out;
  const Index* edge = problem_.incidence.edge.data() + Offset{e} * static_cast<Offset>(local.size());
  for (std::size_t k = 0; k < local.size(); ++k) {
    const double* c = c_.data() + Offset{edge[k]} * B;
    const auto [a, b] = local[k];
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < D; ++j) {
        out[a][i][j] += 4 * c[i] * g[b][j];
        out[b][i][j] += 4 * c[i] * g[a][j];
      }
  }
  return out;
}

/// The residual and stiffness of one bubble, with int phi_x phi_y = |T| (1 + [x = y]) / ((D + 1) (D + 2)).
template <int D, int B>
typename Bubbles<D, B>::Local Bubbles<D, B>::local(Index edge) const {
  constexpr auto ends_of = simplex_edges<D>();
  Local out;
  out.residual = problem_.edge_load[edge];
  const Incidence<D>& incidence = problem_.incidence;
  for (Offset k = incidence.first_at_edge[edge]; k < incidence.first_at_edge[edge + 1]; ++k) {
    const Index e = incidence.at_edge[k] / Index{ends_of.size()};
    const auto [a, b] = ends_of[incidence.at_edge[k] % Index{ends_of.size()}];
    const LinearElement<D>& element = problem_.element[e];
    const Material<B>& material = problem_.material[e];
    const double mass = element.measure / ((D + 1) * (D + 2));
    const Point<D>&ga = element.gradient[a], &gb = element.gradient[b];

    auto H = gradients(e);
    Gradient<D, B> sum{};
    for (int x = 0; x <= D; ++x) add(1, H[x], sum);
    add(1, sum, H[a]);
    add(1, sum, H[b]);
    const auto of_a = applied(flux(material, H[a]), gb), of_b = applied(flux(material, H[b]), ga);
    for (int i = 0; i < B; ++i) out.residual[i] -= 4 * mass * (of_a[i] + of_b[i]);

    const auto aa = stiffness_of(material, ga, ga), bb = stiffness_of(material, gb, gb),
               ab = stiffness_of(material, ga, gb), ba = stiffness_of(material, gb, ga);
    for (int i = 0; i < B * B; ++i) out.stiffness[i] += 16 * mass * (2 * aa[i] + 2 * bb[i] + ab[i] + ba[i]);
  }
  return out;
}

/// The change that the local problem asks for: the free minimiser, moved to the bound along A^-1 n where it is beyond.
template <int D, int B>
std::array<double, B> Bubbles<D, B>::minimiser(Index edge, const Local& local, Index a, Index b) const {
  std::array<double, B> r = local.residual;
  std::array<double, B* B> A = local.stiffness;
  const FixedDirections<B>* fixed =
      problem_.edge_fix[edge] >= 0 ? &problem_.edge_fixes[problem_.edge_fix[edge]] : nullptr;
  if (fixed) {
    project(*fixed, r);
    keep_free<B>(*fixed, A);
  }
  std::array<double, B> step = solved(A, r);
  const auto* bound = problem_.gaps.at_edge(edge);
  if (!bound) return step;
  std::array<double, B> n = bound->direction, now;
  if (fixed) project(*fixed, n);
  if (!(dot(n, n) > same_direction * same_direction)) return step;
  std::copy_n(c_.begin() + Offset{edge} * B, B, now.begin());
  const auto [lower, upper] = range(edge, a, b);
  const double there = dot(bound->direction, now) + dot(bound->direction, step);
  const double back = std::clamp(there, std::min(lower, upper), std::max(lower, upper)) - there;
  if (back == 0) return step;
  const std::array<double, B> way = solved(A, n);
  for (int i = 0; i < B; ++i) step[i] += back / dot(bound->direction, way) * way[i];
  return step;
}

template <int D, int B>
double Bubbles<D, B>::sweep(bool lifted_only) {
  double won = 0;
  any_ = true;
  for (Index e = 0; e < problem_.incidence.edges; ++e) {
    if (lifted_only && !lifted_[e]) continue;
    if (problem_.edge_fix[e] >= 0 && problem_.edge_fixes[problem_.edge_fix[e]].count == B) continue;
    const auto [a, b] = ends(e);
    const Local here = local(e);
    const std::array<double, B> step = minimiser(e, here, a, b);
    for (int i = 0; i < B; ++i) {
      double slope = here.residual[i];
      for (int j = 0; j < B; ++j) slope -= here.stiffness[i * B + j] * step[j] / 2;
      won += step[i] * slope;
      c_[Offset{e} * B + i] += step[i];
    }
  }
  return won;
}

/// With r the residual of the bubbles, from coefficients c_0 to c: -1/2 (c - c_0) . (r(c_0) + r(c)).
template <int D, int B>
double Bubbles<D, B>::energy() const {
  if (!any_lifted_) return 0;
  const Bubbles of_u(problem_);
  double sum = 0;
  for (Index e = 0; e < problem_.incidence.edges; ++e) {
    std::array<double, B> c;
    for (int i = 0; i < B; ++i) c[i] = c_[Offset{e} * B + i] - of_u.c_[Offset{e} * B + i];
    if (dot(c, c) > 0) sum -= (dot(c, of_u.local(e).residual) + dot(c, local(e).residual)) / 2;
  }
  return sum;
}

template class Bubbles<2, 1>;
template class Bubbles<3, 1>;
template class Bubbles<2, 2>;
template class Bubbles<3, 3>;

}  // namespace signorini
