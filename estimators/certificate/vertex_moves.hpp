#pragma once
#include <algorithm>
#include <cmath>

#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/face_moments.hpp"
#include "estimators/certificate/small_solve.hpp"

/// What Bubbles does with the vertices at interfaces of bodies: a part of bubbles.cpp.
namespace signorini {

/// Parts of directions of less are rounding.
inline constexpr double across = 1e-10;
/// Of the largest length: bodies that overlap by less do so by rounding.
inline constexpr double touching = 1e-12;
inline constexpr int sweeps_of_vertices = 3;  // for one over the bubbles

template <int D, int B>
int place_in(const TrueProblem<D, B>& problem, Index e, Index vertex) {
  const Simplex<D>& v = problem.mesh.elements[e];
  return static_cast<int>(std::ranges::find(v, vertex) - v.begin());
}

template <int D, int B>
double largest_length(const TrueProblem<D, B>& problem) {
  double out = 0;
  for (const double x : problem.u.at_vertex) out = std::max(out, std::fabs(x));
  for (const Point<D>& x : problem.mesh.points) out = std::max(out, length<D>(x));
  return out;
}

/// How vertices at interfaces may move: along the normal, where nothing along it is prescribed, and no rigid obstacle
/// met; nor where there is friction, whose slip stays what it is.
template <int D, int B>
void Bubbles<D, B>::find_ways() {
  for (const Index dof : problem_.jumps.dofs())
    if (dof < vertices()) movable_.push_back({dof, problem_.jumps.normal(problem_.jumps.parts(dof).first->row), 0, {}});
  for (const OuterFace<D, B>& outer : problem_.outer) {
    const auto v = face_vertices<D>(problem_.mesh, problem_.incidence.sides[outer.face]);
    for (int k = 0; k < D; ++k) {
      const auto here = std::ranges::lower_bound(movable_, v[k], {}, &Movable::vertex);
      if (here == movable_.end() || here->vertex != v[k]) continue;
      std::array<double, B> left = here->way;
      project(outer.fixed, left);
      for (int i = 0; i < B; ++i) here->load[i] += outer.load[k][i];
      if (!(dot(left, left) > 1 - across)) here->way = {};
    }
  }
  for (const Gaps<D, B>& gaps : problem_.gaps)
    for (Movable& here : movable_)
      if (const auto* bound = gaps.at_vertex(here.vertex))
        if (gaps.friction || std::fabs(dot(bound->direction, here.way)) > across) here.way = {};
  std::erase_if(movable_, [](const Movable& here) { return !(dot(here.way, here.way) > 0); });
  for (Movable& here : movable_)
    for (Offset k = problem_.incidence.first_at_vertex[here.vertex];
         k < problem_.incidence.first_at_vertex[here.vertex + 1]; ++k) {
      const Index e = problem_.incidence.at_vertex[k];
      const Point<D>& g = problem_.element[e].gradient[place_in(problem_, e, here.vertex)];
      const auto K = stiffness_of(problem_.material[e], g, g);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j)
          here.stiffness += problem_.element[e].measure * here.way[i] * K[i * B + j] * here.way[j];
    }
}

/// What is left of the loads on a vertex's hat function.
template <int D, int B>
std::array<double, B> Bubbles<D, B>::residual_at(const Movable& here) const {
  std::array<double, B> out = here.load;
  for (Offset k = problem_.incidence.first_at_vertex[here.vertex];
       k < problem_.incidence.first_at_vertex[here.vertex + 1]; ++k) {
    const Index e = problem_.incidence.at_vertex[k];
    auto s = gradients(e);
    for (auto& g : s) g = flux(problem_.material[e], g);
    const auto of_element = element_residuals<D, B>(problem_, e, s, {});
    for (int i = 0; i < B; ++i) out[i] -= of_element[place_in(problem_, e, here.vertex)][i];
  }
  return out;
}

/// How far a dof may move along a way, back and forth.
template <int D, int B>
std::array<double, 2> Bubbles<D, B>::range(Index dof, const std::array<double, B>& way) const {
  double back = -infinity, forth = infinity;
  const auto [first, last] = problem_.jumps.parts(dof);
  for (auto part = first; part != last; ++part) {
    const double closes = part->factor * dot(problem_.jumps.normal(part->row), way);
    const double left = std::max(0.0, left_[part->row]);
    if (closes > 0) forth = std::min(forth, left / closes);
    if (closes < 0) back = std::max(back, left / closes);
  }
  return {back, forth};
}

template <int D, int B>
void Bubbles<D, B>::change_left(Index dof, const std::array<double, B>& step) {
  const auto [first, last] = problem_.jumps.parts(dof);
  for (auto part = first; part != last; ++part)
    left_[part->row] -= part->factor * dot(problem_.jumps.normal(part->row), step);
}

template <int D, int B>
void Bubbles<D, B>::move(const Movable& here, double by) {
  std::array<double, B> step;
  for (int i = 0; i < B; ++i) {
    step[i] = by * here.way[i];
    at_vertex_[Offset{here.vertex} * B + i] += step[i];
  }
  change_left(here.vertex, step);
}

/// By how much the bodies overlap, at most, where a vertex of the slave has a part.
template <int D, int B>
double Bubbles<D, B>::lack_at(Index vertex) const {
  double lack = 0;
  const auto [first, last] = problem_.jumps.parts(vertex);
  for (auto part = first; part != last; ++part)
    if (part->factor > 0) lack = std::max(lack, -left_[part->row]);
  return lack;
}

/// Each vertex of the slave goes back by the deepest overlap where it has a part: what is linear between them by as
/// much at least.
template <int D, int B>
bool Bubbles<D, B>::lift_jumps() {
  const double rounding = touching * largest_length(problem_);
  std::vector<double> lack;
  for (const Movable& here : movable_) lack.push_back(lack_at(here.vertex));
  bool moved = false;
  for (std::size_t k = 0; k < movable_.size(); ++k) {
    if (!(lack[k] > rounding)) continue;
    move(movable_[k], -lack[k]);
    moved = true;
  }
  for (const Index dof : problem_.jumps.dofs())
    if (moved && dof >= vertices()) lifted_[dof - vertices()] = true;
  any_lifted_ = any_lifted_ || moved;
  left_ = problem_.jumps.left(at_vertex_, c_);
  return std::ranges::all_of(left_, [&](double left) { return left >= -rounding; });
}

/// Projected Gauss-Seidel over the vertices. Returns the energy won.
template <int D, int B>
double Bubbles<D, B>::sweep_jumps() {
  double won = 0;
  for (int sweep = 0; sweep < sweeps_of_vertices; ++sweep)
    for (const Movable& here : movable_) {
      const double force = dot(residual_at(here), here.way);
      const auto [back, forth] = range(here.vertex, here.way);
      const double by = std::clamp(force / here.stiffness, back, forth);
      won += by * (force - here.stiffness * by / 2);
      move(here, by);
    }
  return won;
}

}  // namespace signorini
