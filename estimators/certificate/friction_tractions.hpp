#pragma once
#include <cmath>

#include "estimators/certificate/face_work.hpp"
#include "estimators/certificate/vertex_forces.hpp"

namespace signorini {

/// What friction takes of a slip, at most, and what a traction does along it.
struct SlipWork {
  double most = 0, traction = 0;

  double excess() const { return std::max(0.0, most + traction); }
};

/// Of a slip that is quadratic on a face, or on a piece of one: |v_t| is no more than its Bernstein coefficients say.
/// @param s the largest traction, linear; t the traction, linear
/// @param slip at the corners; between Bernstein coefficients of edges
template <int D, int B>
SlipWork slip_work(double measure, const std::array<double, D>& s, const std::array<std::array<double, B>, D>& t,
                   const std::array<std::array<double, B>, D>& slip,
                   const std::array<std::array<double, B>, D*(D - 1) / 2>& between) {
  constexpr auto ends = simplex_edges<D - 1>();
  const auto length = [](const std::array<double, B>& v) { return std::sqrt(dot(v, v)); };
  const auto integral = [&](const std::array<double, D>& by, const auto& of) {
    std::array<double, D> corner;
    std::array<double, ends.size()> bubble;
    for (int k = 0; k < D; ++k) corner[k] = of(slip[k]);
    for (std::size_t k = 0; k < ends.size(); ++k)
      bubble[k] = (of(between[k]) - (corner[ends[k][0]] + corner[ends[k][1]]) / 2) / 2;
    return measure * integral_over_face<D>(by, corner, bubble);
  };
  SlipWork out{integral(s, length)};
  for (int i = 0; i < B; ++i) {
    std::array<double, D> component;
    for (int k = 0; k < D; ++k) component[k] = t[k][i];
    out.traction += integral(component, [i](const std::array<double, B>& v) { return v[i]; });
  }
  return out;
}

/// Cut down to what friction allows.
template <std::size_t B>
std::array<double, B> cut(std::array<double, B> t, double most) {
  const double size = std::sqrt(dot(t, t));
  for (double& c : t) c *= size > most ? most / size : 1;
  return t;
}

/// Friction of the vertices that it acts at.
template <int D, int B>
class Tractions {
 public:
  /// Keeps references.
  Tractions(const TrueProblem<D, B>& problem, const Gaps<D, B>& gaps, const AtVertices<D, B>& at,
            const std::vector<double>& force, const std::vector<double>& area)
      : problem_(problem), gaps_(gaps), at_(at), force_(force), area_(area) {}

  /// The largest traction, and what a vector has along the obstacle.
  double most(Index p) const {
    const auto* bound = gaps_.at_vertex(p);
    return bound ? bound->law.bound + bound->law.coefficient * std::fabs(force_[p]) / area_[p] : 0;
  }
  std::array<double, B> along(const std::array<double, B>& direction, const double* v) const {
    std::array<double, B> out;
    std::copy_n(v, B, out.begin());
    const double across = dot(out, direction);
    for (int i = 0; i < B; ++i) out[i] -= across * direction[i];
    return out;
  }
  std::array<double, B> slip(Index p) const {
    return along(gaps_.at_vertex(p)->direction, problem_.slip.at_vertex.data() + Offset{p} * B);
  }
  /// What is left of the loads, less what the way since rest costs, as far as friction allows.
  std::array<double, B> operator()(Index p) const {
    std::array<double, B> t = at_.residual[p];
    project(at_.fixed[p], t);
    t = along(gaps_.at_vertex(p)->direction, t.data());
    double stiffness = 0;
    for (int i = 0; i < B; ++i) stiffness = std::max(stiffness, at_.stiffness[p][i * (B + 1)]);
    const std::array<double, B> way = slip(p);
    for (int i = 0; i < B; ++i) t[i] = (t[i] - stiffness * way[i]) / area_[p];
    return cut(t, most(p));
  }

  /// int s |v_t|, at most, and int t . v_t.
  SlipWork work(const OuterFace<D, B>& outer, const std::array<Index, D>& v,
                const std::array<Index, D*(D - 1) / 2>& edge,
                const std::array<std::array<double, B>, D>& traction) const {
    constexpr auto ends = simplex_edges<D - 1>();
    std::array<double, D> s;
    std::array<std::array<double, B>, D> slips;
    for (int k = 0; k < D; ++k) {
      s[k] = most(v[k]);
      slips[k] = slip(v[k]);
    }
    std::array<std::array<double, B>, ends.size()> between;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      std::array<double, B> bubble{};
      const auto* bound = gaps_.at_edge(edge[k]);
      if (bound && !problem_.slip.of_edge.empty())
        bubble = along(bound->direction, problem_.slip.of_edge.data() + Offset{edge[k]} * B);
      const auto [a, b] = ends[k];
      for (int i = 0; i < B; ++i) between[k][i] = (slips[a][i] + slips[b][i]) / 2 + 2 * bubble[i];
    }
    return slip_work<D, B>(length<D>(outer.normal), s, traction, slips, between);
  }

 private:
  const TrueProblem<D, B>& problem_;
  const Gaps<D, B>& gaps_;
  const AtVertices<D, B>& at_;
  const std::vector<double>&force_, &area_;
};

}  // namespace signorini
