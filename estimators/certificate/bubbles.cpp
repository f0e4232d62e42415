#include "estimators/certificate/bubbles.hpp"

#include <algorithm>
#include <cmath>

#include "estimators/certificate/small_solve.hpp"
#include "estimators/certificate/vertex_moves.hpp"

namespace signorini {

template <int D, int B>
Bubbles<D, B>::Bubbles(const TrueProblem<D, B>& problem)
    : problem_(problem),
      any_(!problem.u.of_edge.empty()),
      c_(problem.u.of_edge),
      at_vertex_(problem.u.at_vertex),
      lifted_(static_cast<std::size_t>(problem.incidence.edges)) {
  c_.resize(lifted_.size() * B);
  if (problem.jumps.none()) return;
  left_ = problem.jumps.left(at_vertex_, c_);
  find_ways();
}

template <int D, int B>
std::array<Index, 2> Bubbles<D, B>::ends(Index edge) const {
  constexpr auto local = simplex_edges<D>();
  const Index at = problem_.incidence.at_edge[problem_.incidence.first_at_edge[edge]];
  const Simplex<D>& v = problem_.mesh.elements[at / Index{local.size()}];
  const auto [a, b] = local[at % Index{local.size()}];
  return {v[a], v[b]};
}

template <int D, int B>
const FixedDirections<B>* Bubbles<D, B>::fixed(Index edge) const {
  const Index number = problem_.edge_fix[edge];
  return number < 0 ? nullptr : &problem_.edge_fixes[number];
}

template <int D, int B>
std::array<double, B> Bubbles<D, B>::at(Index edge) const {
  std::array<double, B> c;
  std::copy_n(c_.begin() + Offset{edge} * B, B, c.begin());
  return c;
}

/// Of obstacles: the range of `direction . c`, see Gaps. Along fixed directions c stays. Without obstacles none.
template <int D, int B>
void Bubbles<D, B>::gather_facets(Index edge) {
  facets_.clear();
  const auto add = [&](const std::array<double, B>& normal, double lower, double upper, double tolerated) {
    Facet<B>& facet = facets_.emplace_back();
    std::ranges::copy(normal, facet.normal);
    facet.lower = lower, facet.upper = upper, facet.tolerated = tolerated;
  };
  for (const Gaps<D, B>& gaps : problem_.gaps) {
    const auto* bound = gaps.at_edge(edge);
    if (!bound) continue;
    const auto [a, b] = ends(edge);
    const auto from = distances(problem_, gaps, a), to = distances(problem_, gaps, b);
    const double lower = bound->lower - (from[0] + to[0]) / 4, upper = bound->upper + (from[1] + to[1]) / 4;
    add(bound->direction, std::isnan(lower) ? -infinity : lower, std::isnan(upper) ? infinity : upper, gaps.rounding);
  }
  const auto [first, last] = problem_.jumps.parts(vertices() + edge);
  for (auto part = first; part != last; ++part) {  // rows with one normal follow each other
    const std::array<double, B>& n = problem_.jumps.normal(part->row);
    if (part != first && problem_.jumps.normal((part - 1)->row) == n) continue;
    const auto [back, forth] = range(vertices() + edge, n);
    const double there = dot(n, at(edge));
    add(n, there + back, there + forth, 0);
  }
  const FixedDirections<B>* held = fixed(edge);
  if (facets_.empty() || !held) return;
  for (int k = 0; k < held->count; ++k) {
    std::array<double, B> direction;
    std::copy_n(held->direction[k], B, direction.begin());
    const double there = dot(direction, at(edge));
    add(direction, there, there, facets_.front().tolerated);
  }
}

/// The admissible coefficient that is nearest to c in the norm of M. False: there is none.
template <int D, int B>
bool Bubbles<D, B>::nearest(const std::array<double, B * B>& M, std::array<double, B>& c) const {
  if (facets_.empty()) return true;
  std::array<double, B> lower, upper, y;
  lower.fill(-infinity);
  upper.fill(infinity);
  const Facet<B>* first = facets_.data();
  if (!Polyhedron<B>(lower.data(), upper.data(), first, first + facets_.size()).nearest(M.data(), c.data(), y.data()))
    return false;
  c = y;
  return true;
}

template <int D, int B>
bool Bubbles<D, B>::lift() {
  std::array<double, B * B> identity{};
  for (int i = 0; i < B; ++i) identity[i * (B + 1)] = 1;
  double rounding = 0;
  for (const Gaps<D, B>& gaps : problem_.gaps) rounding = std::max(rounding, gaps.rounding);
  bool possible = true;
  for (Index e = 0; e < problem_.incidence.edges && !problem_.gaps.empty(); ++e) {
    gather_facets(e);
    if (facets_.empty()) continue;
    std::array<double, B> c = at(e);
    if (!nearest(identity, c)) {
      possible = false;
      continue;
    }
    double by = 0;
    for (int i = 0; i < B; ++i) by = std::max(by, std::fabs(c[i] - c_[Offset{e} * B + i]));
    if (by <= rounding) continue;
    std::ranges::copy(c, c_.begin() + Offset{e} * B);
    lifted_[e] = any_lifted_ = any_ = true;
  }
  if (problem_.jumps.none()) return possible;
  left_ = problem_.jumps.left(at_vertex_, c_);
  return lift_jumps() && possible;
}

/// H_x with the gradient sum over x of phi_x H_x: b_xy = 4 phi_x phi_y adds 4 c (x) grad phi_y to H_x.
template <int D, int B>
std::array<Gradient<D, B>, D + 1> Bubbles<D, B>::gradients(Index e) const {
  constexpr auto local = simplex_edges<D>();
  const auto& g = problem_.element[e].gradient;
  std::array<Gradient<D, B>, D + 1> out;
  out.fill(gradient<D, B>(g, problem_.mesh.elements[e], at_vertex_));
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

/// The change that the local problem asks for: to the admissible coefficient nearest to the free minimiser, in the norm
/// of the energy. None where nothing is admissible.
template <int D, int B>
std::array<double, B> Bubbles<D, B>::minimiser(Index edge, const Local& local) {
  std::array<double, B> r = local.residual;
  std::array<double, B* B> A = local.stiffness;
  if (const FixedDirections<B>* held = fixed(edge)) {
    project(*held, r);
    keep_free<B>(*held, A);
  }
  std::array<double, B> step = solved(A, r);
  gather_facets(edge);
  if (facets_.empty()) return step;
  const std::array<double, B> now = at(edge);
  std::array<double, B> c = now;
  for (int i = 0; i < B; ++i) c[i] += step[i];
  if (!nearest(A, c)) return {};
  for (int i = 0; i < B; ++i) step[i] = c[i] - now[i];
  return step;
}

template <int D, int B>
double Bubbles<D, B>::sweep(bool lifted_only) {
  double won = sweep_jumps();
  any_ = true;
  for (Index e = 0; e < problem_.incidence.edges; ++e) {
    if (lifted_only && !lifted_[e]) continue;
    if (problem_.edge_fix[e] >= 0 && problem_.edge_fixes[problem_.edge_fix[e]].count == B) continue;
    const Local here = local(e);
    const std::array<double, B> step = minimiser(e, here);
    for (int i = 0; i < B; ++i) {
      double slope = here.residual[i];
      for (int j = 0; j < B; ++j) slope -= here.stiffness[i * B + j] * step[j] / 2;
      won += step[i] * slope;
      c_[Offset{e} * B + i] += step[i];
    }
    change_left(vertices() + e, step);
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
  for (const Movable& here : movable_) {
    std::array<double, B> way;
    for (int i = 0; i < B; ++i) {
      const Offset k = Offset{here.vertex} * B + i;
      way[i] = at_vertex_[k] - of_u.at_vertex_[k];
    }
    sum -= (dot(way, of_u.residual_at(here)) + dot(way, residual_at(here))) / 2;
  }
  return sum;
}

#define SIGNORINI_INSTANTIATE(D, B) template class Bubbles<D, B>;
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
