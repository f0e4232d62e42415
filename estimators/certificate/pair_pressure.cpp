#include "estimators/certificate/pair_pressure.hpp"

#include <cmath>

#include "estimators/certificate/face_work.hpp"
#include "estimators/certificate/trace_constant.hpp"
#include "estimators/certificate/uneven_pressure.hpp"

namespace signorini {
namespace {

/// Of the square of a pressure: so much of what is not linear is rounding.
constexpr double no_remainder = 1e-14;

template <int D>
class PairPressure {
 public:
  PairPressure(const TrueProblem<D, D>& problem, Index interface, Contact<D, D>& out)
      : problem_(problem), interface_(interface), here_(problem.interfaces[interface]), out_(out) {}

  void press(const AtVertices<D, D>& at, const Bubbles<D, D>& bubbles) {
    find_density(at);
    loads_.resize(problem_.outer.size());
    for (std::size_t n = 0; n < here_.pieces.size(); ++n) add(n, bubbles.left());
    for (std::size_t n = 0; n < loads_.size(); ++n)
      if (loads_[n].square > 0) hand_over(n);
  }

 private:
  /// Of a face: moments of the pressure on it, and the integral of its square.
  struct Load {
    std::array<double, D> moment{};
    double square = 0, sign = 0;
    std::vector<PressureOnPart> parts{};  // D = 2
  };

  std::array<Index, D> vertices(Index outer) const {
    return face_vertices<D>(problem_.mesh, problem_.incidence.sides[problem_.outer[outer].face]);
  }

  /// The force at each vertex of the slave over what is covered of its hat function; none where the bodies are farther
  /// apart than the force would cost.
  void find_density(const AtVertices<D, D>& at) {
    const std::vector<double> left = problem_.jumps.left(problem_.u.at_vertex, problem_.u.of_edge);
    density_.assign(problem_.mesh.points.size(), 0);
    std::vector<double> area(density_.size()), nearest(density_.size(), infinity);
    for (std::size_t n = 0; n < here_.pieces.size(); ++n) {
      const FacingPiece<D>& piece = here_.pieces[n];
      const auto v = vertices(piece.slave);
      for (int c = 0; c < D; ++c)
        for (int i = 0; i < D; ++i) {
          area[v[i]] += piece.measure / D * piece.on_slave[c][i];
          if (piece.on_slave[c][i] == 1)
            nearest[v[i]] = std::min(nearest[v[i]], left[problem_.jumps.row(interface_, n, c)]);
        }
    }
    for (std::size_t p = 0; p < area.size(); ++p) {
      if (!(area[p] > 0)) continue;
      std::array<double, D> n = here_.normal;
      project(at.fixed[p], n);
      const double free = dot(n, n);
      if (!(free > same_direction)) continue;
      const double force = -dot(n, at.residual[p]) / free;
      const double distance = nearest[p] < infinity ? nearest[p] : 0;
      if (force > std::max(0.0, at.stiffness_along(static_cast<Index>(p), here_.normal) * distance))
        density_[p] = force / area[p];
    }
  }

  void add(std::size_t n, const std::vector<double>& left) {
    const FacingPiece<D>& piece = here_.pieces[n];
    const auto v = vertices(piece.slave);
    std::array<double, D> p{}, distance;
    double sum = 0;
    for (int c = 0; c < D; ++c) {
      for (int i = 0; i < D; ++i) p[c] += piece.on_slave[c][i] * density_[v[i]];
      sum += p[c];
    }
    if (!(sum > 0)) return;
    Load& slave = loads_[piece.slave];
    Load& master = loads_[piece.master];
    slave.sign = -1, master.sign = 1;
    for (int c = 0; c < D; ++c) {
      const double part = piece.measure / (D * (D + 1)) * (sum + p[c]);
      for (int i = 0; i < D; ++i) {
        slave.moment[i] += part * piece.on_slave[c][i];
        master.moment[i] += part * piece.on_master[c][i];
      }
      slave.square += part * p[c];
      master.square += part * p[c];
      distance[c] = std::max(0.0, left[problem_.jumps.row(interface_, n, c)]);
    }
    if constexpr (D == 2) {
      slave.parts.push_back(on_part(piece.on_slave, p));
      master.parts.push_back(on_part(piece.on_master, p));
    }
    constexpr auto ends = simplex_edges<D - 1>();
    std::array<double, ends.size()> bubble;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto [a, b] = ends[k];
      const double between = std::max(0.0, left[problem_.jumps.row(interface_, n, D + static_cast<int>(k))]);
      bubble[k] = (between - (distance[a] + distance[b]) / 2) / 2;
    }
    const Index e = problem_.incidence.sides[problem_.outer[piece.slave].face].element[0];
    out_.work[e] += piece.measure * integral_over_face<D>(p, distance, bubble);
  }

  static PressureOnPart on_part(const std::array<std::array<double, D>, D>& at, const std::array<double, D>& p) {
    const int first = at[0][1] < at[1][1] ? 0 : 1;
    return {at[first][1], at[1 - first][1], p[first], p[1 - first]};
  }

  /// Moments to the faces; what is not linear on one to the oscillation.
  void hand_over(std::size_t n) {
    const Load& load = loads_[n];
    const OuterFace<D, D>& outer = problem_.outer[n];
    const double face = length<D>(outer.normal);
    double sum = 0, linear = 0;
    for (const double m : load.moment) sum += m;
    for (int k = 0; k < D; ++k) {
      for (int i = 0; i < D; ++i) out_.forces.on_face[n][k][i] += load.sign * load.moment[k] * here_.normal[i];
      linear += D * ((D + 1) * load.moment[k] - sum) / face * load.moment[k];
    }
    if (!(load.square - linear > no_remainder * load.square)) return;
    if (out_.oscillation.empty()) out_.oscillation.assign(problem_.element.size(), 0);
    const Index e = problem_.incidence.sides[outer.face].element[0];
    const auto corner = corners<D>(problem_.mesh.points, problem_.mesh.elements[e]);
    const double factor = trace_factor<D>(problem_.element[e], corner, problem_.material[e], face, here_.normal);
    const double computed = std::sqrt(factor * (load.square - linear));
    double proven = infinity;
    if constexpr (D == 2) proven = norm_of_uneven(n, load);
    out_.oscillation[e] += std::min(computed, proven);
    out_.computed_constant |= computed < proven;
  }

  double norm_of_uneven(std::size_t n, const Load& load) const requires(D == 2) {
    const OuterFace<D, D>& outer = problem_.outer[n];
    const auto& sides = problem_.incidence.sides[outer.face];
    const auto& x = problem_.mesh.points;
    const auto v = vertices(static_cast<Index>(n));
    const Index e = sides.element[0];
    const double sum = load.moment[0] + load.moment[1];
    std::array<double, 2> linear;
    for (int k = 0; k < D; ++k) linear[k] = D * ((D + 1) * load.moment[k] - sum) / length<D>(outer.normal);
    return signorini::norm_of_uneven({x[v[0]], x[v[1]], x[problem_.mesh.elements[e][sides.opposite[0]]]},
                                     problem_.material[e], here_.normal, load.parts, linear);
  }

  const TrueProblem<D, D>& problem_;
  const Index interface_;
  const ContactInterface<D>& here_;
  Contact<D, D>& out_;
  std::vector<double> density_;  // per vertex
  std::vector<Load> loads_;      // per outer face
};

}  // namespace

template <int D>
void press_between(const TrueProblem<D, D>& problem, const AtVertices<D, D>& at, const Bubbles<D, D>& bubbles,
                   Contact<D, D>& out) {
  if (problem.interfaces.empty()) return;
  out.forces.on_face.resize(problem.outer.size());
  for (std::size_t k = 0; k < problem.interfaces.size(); ++k)
    PairPressure<D>(problem, static_cast<Index>(k), out).press(at, bubbles);
}

template void press_between(const TrueProblem<2, 2>&, const AtVertices<2, 2>&, const Bubbles<2, 2>&, Contact<2, 2>&);
template void press_between(const TrueProblem<3, 3>&, const AtVertices<3, 3>&, const Bubbles<3, 3>&, Contact<3, 3>&);

}  // namespace signorini
