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
    double stiffness = 0, square = 0;
    for (int i = 0; i < B; ++i) stiffness = std::max(stiffness, at_.stiffness[p][i * (B + 1)]);
    const std::array<double, B> way = slip(p);
    for (int i = 0; i < B; ++i) {
      t[i] = (t[i] - stiffness * way[i]) / area_[p];
      square += t[i] * t[i];
    }
    const double size = std::sqrt(square), most = this->most(p);
    for (double& c : t) c *= size > most ? most / size : 1;
    return t;
  }

  /// int s |v_t|, at most, and int t . v_t: |v_t| is no more than its Bernstein coefficients say.
  SlipWork work(const OuterFace<D, B>& outer, const std::array<Index, D>& v,
                const std::array<Index, D*(D - 1) / 2>& edge,
                const std::array<std::array<double, B>, D>& traction) const {
    constexpr auto ends = simplex_edges<D - 1>();
    std::array<double, D> s, way;
    std::array<std::array<double, B>, D> slips;
    for (int k = 0; k < D; ++k) {
      s[k] = most(v[k]);
      slips[k] = slip(v[k]);
      way[k] = length(slips[k]);
    }
    std::array<std::array<double, B>, ends.size()> bubble{};
    std::array<double, ends.size()> of_edge{};
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto* bound = gaps_.at_edge(edge[k]);
      if (bound && !problem_.slip.of_edge.empty())
        bubble[k] = along(bound->direction, problem_.slip.of_edge.data() + Offset{edge[k]} * B);
      const auto [a, b] = ends[k];
      std::array<double, B> middle;
      for (int i = 0; i < B; ++i) middle[i] = (slips[a][i] + slips[b][i]) / 2 + 2 * bubble[k][i];
      of_edge[k] = (length(middle) - (way[a] + way[b]) / 2) / 2;
    }
    const double measure = signorini::length<D>(outer.normal);
    SlipWork out{measure * integral_over_face<D>(s, way, of_edge)};
    for (int i = 0; i < B; ++i) {
      std::array<double, D> t, x;
      std::array<double, ends.size()> w;
      for (int k = 0; k < D; ++k) t[k] = traction[k][i], x[k] = slips[k][i];
      for (std::size_t k = 0; k < ends.size(); ++k) w[k] = bubble[k][i];
      out.traction += measure * integral_over_face<D>(t, x, w);
    }
    return out;
  }

 private:
  static double length(const std::array<double, B>& v) { return std::sqrt(dot(v, v)); }

  const TrueProblem<D, B>& problem_;
  const Gaps<D, B>& gaps_;
  const AtVertices<D, B>& at_;
  const std::vector<double>&force_, &area_;
};

}  // namespace signorini
