#include "estimators/certificate/contact_forces.hpp"

#include <cmath>

#include "estimators/certificate/small_solve.hpp"

namespace signorini {
namespace {

/// At the vertices: what is left of the loads, and how stiff the body is there.
template <int D, int B>
struct AtVertices {
  std::vector<std::array<double, B>> residual;
  std::vector<std::array<double, B * B>> stiffness;
  std::vector<FixedDirections<B>> fixed;

  explicit AtVertices(const TrueProblem<D, B>& problem)
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
};

/// What an obstacle exerts along its direction, positive from the lower bound: where it pushes more than the way to the
/// bound would cost, as active sets decide.
template <int D, int B>
double force_at(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at, Index p) {
  const auto* bound = problem.gaps.at_vertex(p);
  if (!bound) return 0;
  std::array<double, B> n = bound->direction;
  project(at.fixed[p], n);
  const double free = dot(n, bound->direction);
  if (!(free > same_direction)) return 0;
  const double force = dot(n, at.residual[p]) / free;
  double stiffness = 0;
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) stiffness += bound->direction[i] * at.stiffness[p][i * B + j] * bound->direction[j];
  const auto [below, above] = distances(problem, p);
  if (force > stiffness * below || -force > stiffness * above) return force;
  return 0;
}

/// Coefficients, at vertices and edges, of the distance of v from one of its bounds.
template <int D, int B>
class Bounded {
 public:
  Bounded(const TrueProblem<D, B>& problem, const Bubbles<D, B>& bubbles) : problem_(problem), bubbles_(bubbles) {}

  double at_vertex(Index p, bool upper) const { return distances(problem_, p)[upper]; }
  double at_edge(Index e, bool upper) const {
    const auto* bound = problem_.gaps.at_edge(e);
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
  const Bubbles<D, B>& bubbles_;
};

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

/// In the order of simplex_edges of its vertices.
template <int D, int B>
std::array<Index, D*(D - 1) / 2> edges_of(const TrueProblem<D, B>& problem, const OuterFace<D, B>& outer,
                                          const std::array<Index, D>& v) {
  constexpr auto of_face = simplex_edges<D - 1>();
  constexpr auto of_element = simplex_edges<D>();
  const Index e = problem.incidence.sides[outer.face].element[0];
  const Simplex<D>& corner = problem.mesh.elements[e];
  std::array<Index, D*(D - 1) / 2> out{};
  for (std::size_t k = 0; k < of_face.size(); ++k)
    for (std::size_t m = 0; m < of_element.size(); ++m) {
      const std::array ends{corner[of_element[m][0]], corner[of_element[m][1]]};
      if (sorted(ends) == sorted(std::array{v[of_face[k][0]], v[of_face[k][1]]}))
        out[k] = problem.incidence.edge[static_cast<std::size_t>(e) * of_element.size() + m];
    }
  return out;
}

template <int D, int B>
double work_on_face(const TrueProblem<D, B>& problem, const OuterFace<D, B>& outer, const std::array<Index, D>& v,
                    const std::array<double, D>& p, const Bounded<D, B>& distance) {
  const auto edges = edges_of<D, B>(problem, outer, v);
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

/// The density, at the vertices of a face, of what is loaded onto it: its mass matrix inverted.
template <int D, int B>
std::array<double, D> density(const OuterFace<D, B>& outer) {
  std::array<double, D> out;
  double sum = 0;
  for (const auto& moment : outer.load) sum += moment[0];
  for (int k = 0; k < D; ++k) out[k] = D * ((D + 1) * outer.load[k][0] - sum) / length<D>(outer.normal);
  return out;
}

/// In the body, but where it ends: a load there that pushes towards the obstacle is met by the obstacle right there, as
/// a measure on the face, and not by elements. Returns what is left of the forces for these.
template <int D, int B>
std::vector<double> meet_loads_on_faces(const TrueProblem<D, B>& problem, const std::vector<double>& force,
                                        const Bounded<D, B>& distance, Contact<D, B>& out) {
  std::vector<std::size_t> loaded;
  std::vector<double> load(force.size()), left = force;
  for (std::size_t n = 0; n < problem.outer.size(); ++n) {
    const OuterFace<D, B>& outer = problem.outer[n];
    const auto v = face_vertices<D>(problem.mesh, problem.incidence.sides[outer.face]);
    const auto t = density<D, B>(outer);
    bool pushes = outer.open();
    for (int k = 0; k < D; ++k) pushes = pushes && force[v[k]] * t[k] < 0 && t[k] * t[0] > 0;
    if (!pushes) continue;
    loaded.push_back(n);
    for (int k = 0; k < D; ++k) load[v[k]] += outer.load[k][0];
  }
  if (!loaded.empty()) out.forces.on_face.resize(problem.outer.size());
  for (const std::size_t n : loaded) {
    const OuterFace<D, B>& outer = problem.outer[n];
    const auto& sides = problem.incidence.sides[outer.face];
    const auto v = face_vertices<D>(problem.mesh, sides);
    double part = 1;  // no more than the forces are
    for (const Index p : v) part = std::min(part, -force[p] / load[p]);
    std::array<double, D> pressure = density<D, B>(outer);
    for (int k = 0; k < D; ++k) {
      pressure[k] *= -part;
      out.forces.on_face[n][k][0] = -part * outer.load[k][0];
      left[v[k]] += part * outer.load[k][0];
    }
    out.work[sides.element[0]] += work_on_face<D, B>(problem, outer, v, pressure, distance);
  }
  return left;
}

/// In the body: more to elements that are in contact as a whole, where a force does no work.
template <int D, int B>
void divide_in_body(const TrueProblem<D, B>& problem, const std::vector<double>& force, const Bounded<D, B>& distance,
                    Contact<D, B>& out) {
  constexpr double sharpness = 0.1;
  const Incidence<D>& incidence = problem.incidence;
  out.forces.in_element.assign(problem.element.size() * (D + 1), 0);
  std::vector<double> weight, gap;
  for (Index p = 0; p < problem.mesh.vertices(); ++p) {
    if (force[p] == 0) continue;
    const Offset first = incidence.first_at_vertex[p], last = incidence.first_at_vertex[p + 1];
    gap.clear(), weight.clear();
    double largest = 0, sum = 0;
    for (Offset k = first; k < last; ++k) {
      gap.push_back(std::max(0.0, distance.mean(incidence.at_vertex[k], force[p] < 0)));
      largest = std::max(largest, gap.back());
    }
    for (Offset k = first; k < last; ++k) {
      const double near = largest > 0 ? sharpness / (sharpness + gap[k - first] / largest) : 1;
      weight.push_back(near * problem.element[incidence.at_vertex[k]].measure);
      sum += weight.back();
    }
    for (Offset k = first; k < last; ++k) {
      const Index e = incidence.at_vertex[k];
      const auto a = std::ranges::find(problem.mesh.elements[e], p) - problem.mesh.elements[e].begin();
      const double share = force[p] * weight[k - first] / sum;
      out.forces.in_element[Offset{e} * (D + 1) + a] = share;
      out.work[e] += std::fabs(share) * gap[k - first];
    }
  }
}

/// Friction of the vertices that it acts at.
template <int D, int B>
class Tractions {
 public:
  Tractions(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at, const std::vector<double>& force,
            const std::vector<double>& area)
      : problem_(problem), at_(at), force_(force), area_(area) {}

  /// The largest traction, and what a vector has along the obstacle.
  double most(Index p) const {
    const auto* bound = problem_.gaps.at_vertex(p);
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
    return along(problem_.gaps.at_vertex(p)->direction, problem_.slip.at_vertex.data() + Offset{p} * B);
  }
  /// What is left of the loads, less what the way since rest costs, as far as friction allows.
  std::array<double, B> operator()(Index p) const {
    std::array<double, B> t = at_.residual[p];
    project(at_.fixed[p], t);
    t = along(problem_.gaps.at_vertex(p)->direction, t.data());
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

  /// int s |v_t| + t . v_t, at most: |v_t| is no more than its Bernstein coefficients say.
  double work(const OuterFace<D, B>& outer, const std::array<Index, D>& v, const std::array<Index, D*(D - 1) / 2>& edge,
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
      const auto* bound = problem_.gaps.at_edge(edge[k]);
      if (bound && !problem_.slip.of_edge.empty())
        bubble[k] = along(bound->direction, problem_.slip.of_edge.data() + Offset{edge[k]} * B);
      const auto [a, b] = ends[k];
      std::array<double, B> middle;
      for (int i = 0; i < B; ++i) middle[i] = (slips[a][i] + slips[b][i]) / 2 + 2 * bubble[k][i];
      of_edge[k] = (length(middle) - (way[a] + way[b]) / 2) / 2;
    }
    double sum = integral_over_face<D>(s, way, of_edge);
    for (int i = 0; i < B; ++i) {
      std::array<double, D> t, x;
      std::array<double, ends.size()> w;
      for (int k = 0; k < D; ++k) t[k] = traction[k][i], x[k] = slips[k][i];
      for (std::size_t k = 0; k < ends.size(); ++k) w[k] = bubble[k][i];
      sum += integral_over_face<D>(t, x, w);
    }
    return std::max(0.0, sum) * signorini::length<D>(outer.normal);
  }

 private:
  static double length(const std::array<double, B>& v) { return std::sqrt(dot(v, v)); }

  const TrueProblem<D, B>& problem_;
  const AtVertices<D, B>& at_;
  const std::vector<double>&force_, &area_;
};

/// On faces: a linear pressure, and linear tractions of friction.
template <int D, int B>
void press_on_faces(const TrueProblem<D, B>& problem, const AtVertices<D, B>& at, const std::vector<double>& force,
                    const Bounded<D, B>& distance, Contact<D, B>& out) {
  std::vector<double> area(force.size());
  for (const OuterFace<D, B>& outer : problem.outer)
    if (outer.contact)
      for (const Index v : face_vertices<D>(problem.mesh, problem.incidence.sides[outer.face]))
        area[v] += length<D>(outer.normal) / D;
  out.forces.on_face.resize(problem.outer.size());
  const Tractions<D, B> friction(problem, at, force, area);
  for (std::size_t n = 0; n < problem.outer.size(); ++n) {
    const OuterFace<D, B>& outer = problem.outer[n];
    if (!outer.contact) continue;
    const auto& sides = problem.incidence.sides[outer.face];
    const auto v = face_vertices<D>(problem.mesh, sides);
    const double measure = length<D>(outer.normal);
    std::array<double, D> p;
    for (int k = 0; k < D; ++k) p[k] = force[v[k]] / area[v[k]];
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m)
        if (const auto* bound = problem.gaps.at_vertex(v[m]))
          for (int i = 0; i < B; ++i)
            out.forces.on_face[n][k][i] += measure * (1 + (k == m)) / (D * (D + 1)) * p[m] * bound->direction[i];
    out.work[sides.element[0]] += work_on_face<D, B>(problem, outer, v, p, distance);
    const auto bounded = [&](Index vertex) { return problem.gaps.at_vertex(vertex) != nullptr; };
    if (!problem.gaps.friction || !std::ranges::all_of(v, bounded)) continue;
    std::array<std::array<double, B>, D> t;
    for (int k = 0; k < D; ++k) t[k] = friction(v[k]);
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m)
        for (int i = 0; i < B; ++i) out.forces.on_face[n][k][i] += measure * (1 + (k == m)) / (D * (D + 1)) * t[m][i];
    const double work = friction.work(outer, v, edges_of<D, B>(problem, outer, v), t);
    out.work[sides.element[0]] += work;
    out.friction += work;
  }
}

}  // namespace

template <int D, int B>
Contact<D, B> contact_of(const TrueProblem<D, B>& problem, const Bubbles<D, B>& bubbles) {
  Contact<D, B> out;
  out.work.assign(problem.element.size(), 0);
  if (!problem.gaps.any()) return out;
  const AtVertices<D, B> at(problem);
  std::vector<double> force(problem.mesh.points.size());
  for (Index p = 0; p < problem.mesh.vertices(); ++p) force[p] = force_at(problem, at, p);
  const Bounded<D, B> distance(problem, bubbles);
  if (problem.gaps.in_body)
    divide_in_body(problem, meet_loads_on_faces(problem, force, distance, out), distance, out);
  else
    press_on_faces(problem, at, force, distance, out);
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B) template Contact<D, B> contact_of(const TrueProblem<D, B>&, const Bubbles<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
