#include "estimators/certificate/pair_pressure.hpp"

#include <cmath>

#include "estimators/certificate/face_work.hpp"
#include "estimators/certificate/friction_tractions.hpp"
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
    find_covered();
    find_density(at);
    apply(density_, scaled(-1, here_.normal));
    for (std::size_t n = 0; n < here_.pieces.size(); ++n) add_work(n, bubbles.left());
    if (here_.law.empty()) return;
    find_tractions(at);
    for (const Point<D>& along : tangents()) apply(component(along), along);
    for (std::size_t n = 0; n < here_.pieces.size(); ++n) add_friction(n);
  }

 private:
  /// Of a face: moments of a component of the traction on it, and the integral of its square.
  struct Load {
    std::array<double, D> moment{};
    double square = 0, sign = 0;
    std::vector<PressureOnPart> parts{};  // D = 2
  };

  std::array<Index, D> vertices(Index outer) const {
    return face_vertices<D>(problem_.mesh, problem_.incidence.sides[problem_.outer[outer].face]);
  }

  Index row(std::size_t piece, int k) const { return problem_.jumps.row(interface_, piece, k); }
  static Point<D> scaled(double by, Point<D> v) {
    for (double& c : v) c *= by;
    return v;
  }
  Point<D> along(Point<D> v) const {
    const double across = dot(v, here_.normal);
    for (int i = 0; i < D; ++i) v[i] -= across * here_.normal[i];
    return v;
  }
  /// Orthonormal ones.
  std::array<Point<D>, D - 1> tangents() const {
    std::array<Point<D>, D - 1> out;
    const auto least = std::ranges::min_element(here_.normal, {}, [](double c) { return std::fabs(c); });
    Point<D> axis{};
    axis[static_cast<std::size_t>(least - here_.normal.begin())] = 1;
    out[0] = along(axis);
    normalise(out[0]);
    if constexpr (D == 3) out[1] = cross(here_.normal, out[0]);
    return out;
  }

  /// Of the slave's vertices what is covered of their hat functions, and what the piece around them knows.
  void find_covered() {
    const std::size_t vertices_of_mesh = problem_.mesh.points.size();
    area_.assign(vertices_of_mesh, 0);
    nearest_.assign(vertices_of_mesh, infinity);
    slip_.assign(vertices_of_mesh, {});
    const std::vector<double> left = problem_.jumps.left(problem_.u.at_vertex, problem_.u.of_edge);
    for (std::size_t n = 0; n < here_.pieces.size(); ++n) {
      const FacingPiece<D>& piece = here_.pieces[n];
      const auto v = vertices(piece.slave);
      for (int c = 0; c < D; ++c)
        for (int i = 0; i < D; ++i) {
          area_[v[i]] += piece.measure / D * piece.on_slave[c][i];
          if (piece.on_slave[c][i] != 1) continue;
          nearest_[v[i]] = std::min(nearest_[v[i]], left[row(n, c)]);
          if (!here_.law.empty()) slip_[v[i]] = slip(n, c);
        }
    }
  }

  /// By how much bodies have slipped since they were at rest, see JumpConditions::jump().
  Point<D> slip(std::size_t piece, int k) const {
    return along(problem_.jumps.jump(row(piece, k), problem_.slip.at_vertex, problem_.slip.of_edge));
  }

  /// The force at each vertex of the slave over what is covered of its hat function; none where the bodies are farther
  /// apart than the force would cost.
  void find_density(const AtVertices<D, D>& at) {
    density_.assign(area_.size(), 0);
    for (std::size_t p = 0; p < area_.size(); ++p) {
      if (!(area_[p] > 0)) continue;
      std::array<double, D> n = here_.normal;
      project(at.fixed[p], n);
      const double free = dot(n, n);
      if (!(free > same_direction)) continue;
      const double force = -dot(n, at.residual[p]) / free;
      const double distance = nearest_[p] < infinity ? nearest_[p] : 0;
      if (force > std::max(0.0, at.stiffness_along(static_cast<Index>(p), here_.normal) * distance))
        density_[p] = force / area_[p];
    }
  }

  double most(Index p) const { return here_.law[p].bound + here_.law[p].coefficient * density_[p]; }

  /// What is left of the loads at the slave's vertices, less what the way since rest costs, as far as friction allows.
  void find_tractions(const AtVertices<D, D>& at) {
    traction_.assign(area_.size(), {});
    for (std::size_t p = 0; p < area_.size(); ++p) {
      if (!(area_[p] > 0)) continue;
      Point<D> t = at.residual[p];
      project(at.fixed[p], t);
      t = along(t);
      double stiffness = 0;
      for (int i = 0; i < D; ++i) stiffness = std::max(stiffness, at.stiffness[p][i * (D + 1)]);
      for (int i = 0; i < D; ++i) t[i] = (t[i] - stiffness * slip_[p][i]) / area_[p];
      traction_[p] = cut(t, most(static_cast<Index>(p)));
    }
  }
  std::vector<double> component(const Point<D>& along) const {
    std::vector<double> out;
    out.reserve(traction_.size());
    for (const Point<D>& t : traction_) out.push_back(dot(t, along));
    return out;
  }

  /// What has these values at the slave's vertices, at the corners of a piece.
  template <class Value>
  std::array<double, D> on_piece(const FacingPiece<D>& piece, const Value& value) const {
    const auto v = vertices(piece.slave);
    std::array<double, D> out{};
    for (int c = 0; c < D; ++c)
      for (int i = 0; i < D; ++i) out[c] += piece.on_slave[c][i] * value(v[i]);
    return out;
  }

  /// A traction on the slave along a direction, and the opposite one on the master.
  void apply(const std::vector<double>& density, const Point<D>& direction) {
    loads_.assign(problem_.outer.size(), {});
    for (const FacingPiece<D>& piece : here_.pieces) add(piece, density);
    for (std::size_t n = 0; n < loads_.size(); ++n)
      if (loads_[n].square > 0) hand_over(n, direction);
  }

  void add(const FacingPiece<D>& piece, const std::vector<double>& density) {
    const std::array<double, D> p = on_piece(piece, [&](Index v) { return density[v]; });
    double sum = 0;
    for (const double c : p) sum += c;
    if (std::ranges::all_of(p, [](double c) { return c == 0; })) return;
    Load& slave = loads_[piece.slave];
    Load& master = loads_[piece.master];
    slave.sign = 1, master.sign = -1;
    for (int c = 0; c < D; ++c) {
      const double part = piece.measure / (D * (D + 1)) * (sum + p[c]);
      for (int i = 0; i < D; ++i) {
        slave.moment[i] += part * piece.on_slave[c][i];
        master.moment[i] += part * piece.on_master[c][i];
      }
      slave.square += part * p[c];
      master.square += part * p[c];
    }
    if constexpr (D == 2) {
      slave.parts.push_back(on_part(piece.on_slave, p));
      master.parts.push_back(on_part(piece.on_master, p));
    }
  }

  Index element_of(const FacingPiece<D>& piece) const {
    return problem_.incidence.sides[problem_.outer[piece.slave].face].element[0];
  }

  /// What the pressure does on the way that is left.
  void add_work(std::size_t n, const std::vector<double>& left) {
    const FacingPiece<D>& piece = here_.pieces[n];
    const std::array<double, D> p = on_piece(piece, [&](Index v) { return density_[v]; });
    std::array<double, D> distance;
    for (int c = 0; c < D; ++c) distance[c] = std::max(0.0, left[row(n, c)]);
    constexpr auto ends = simplex_edges<D - 1>();
    std::array<double, ends.size()> bubble;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto [a, b] = ends[k];
      const double between = std::max(0.0, left[row(n, D + static_cast<int>(k))]);
      bubble[k] = (between - (distance[a] + distance[b]) / 2) / 2;
    }
    out_.work[element_of(piece)] += piece.measure * integral_over_face<D>(p, distance, bubble);
  }

  void add_friction(std::size_t n) {
    const FacingPiece<D>& piece = here_.pieces[n];
    const std::array<double, D> s = on_piece(piece, [&](Index v) { return most(v); });
    std::array<Point<D>, D> t, corner;
    std::array<Point<D>, D*(D - 1) / 2> between;
    for (int i = 0; i < D; ++i) {
      const auto of_t = on_piece(piece, [&](Index v) { return traction_[v][i]; });
      for (int c = 0; c < D; ++c) t[c][i] = of_t[c];
    }
    for (int c = 0; c < D; ++c) corner[c] = slip(n, c);
    for (std::size_t k = 0; k < between.size(); ++k) between[k] = slip(n, D + static_cast<int>(k));
    const SlipWork work = slip_work<D, D>(piece.measure, s, t, corner, between);
    out_.work[element_of(piece)] += work.excess();
    out_.friction += work.excess();
    out_.friction_energy += work.most;
  }

  static PressureOnPart on_part(const std::array<std::array<double, D>, D>& at, const std::array<double, D>& p) {
    const int first = at[0][1] < at[1][1] ? 0 : 1;
    return {at[first][1], at[1 - first][1], p[first], p[1 - first]};
  }

  /// Moments to the faces; what is not linear on one to the oscillation.
  void hand_over(std::size_t n, const Point<D>& direction) {
    const Load& load = loads_[n];
    const OuterFace<D, D>& outer = problem_.outer[n];
    const double face = length<D>(outer.normal);
    double sum = 0, linear = 0;
    for (const double m : load.moment) sum += m;
    for (int k = 0; k < D; ++k) {
      for (int i = 0; i < D; ++i) out_.forces.on_face[n][k][i] += load.sign * load.moment[k] * direction[i];
      linear += D * ((D + 1) * load.moment[k] - sum) / face * load.moment[k];
    }
    if (!(load.square - linear > no_remainder * load.square)) return;
    if (out_.oscillation.empty()) out_.oscillation.assign(problem_.element.size(), 0);
    const Index e = problem_.incidence.sides[outer.face].element[0];
    const auto corner = corners<D>(problem_.mesh.points, problem_.mesh.elements[e]);
    const double factor = trace_factor<D>(problem_.element[e], corner, problem_.material[e], face, direction);
    const double computed = std::sqrt(factor * (load.square - linear));
    double proven = infinity;
    if constexpr (D == 2) proven = norm_of_uneven(n, load, direction);
    out_.oscillation[e] += std::min(computed, proven);
    out_.computed_constant |= computed < proven;
  }

  double norm_of_uneven(std::size_t n, const Load& load, const Point<D>& direction) const requires(D == 2) {
    const OuterFace<D, D>& outer = problem_.outer[n];
    const auto& sides = problem_.incidence.sides[outer.face];
    const auto& x = problem_.mesh.points;
    const auto v = vertices(static_cast<Index>(n));
    const Index e = sides.element[0];
    const double sum = load.moment[0] + load.moment[1];
    std::array<double, 2> linear;
    for (int k = 0; k < D; ++k) linear[k] = D * ((D + 1) * load.moment[k] - sum) / length<D>(outer.normal);
    return signorini::norm_of_uneven({x[v[0]], x[v[1]], x[problem_.mesh.elements[e][sides.opposite[0]]]},
                                     problem_.material[e], direction, load.parts, linear);
  }

  const TrueProblem<D, D>& problem_;
  const Index interface_;
  const ContactInterface<D>& here_;
  Contact<D, D>& out_;
  std::vector<double> density_, area_, nearest_;  // per vertex: pressures, what is covered, distances
  std::vector<Point<D>> slip_, traction_;         // per vertex, along the interface
  std::vector<Load> loads_;                       // per outer face
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
