#include "estimators/certificate/contact_forces.hpp"

#include "estimators/certificate/friction_tractions.hpp"
#include "estimators/certificate/pair_pressure.hpp"

namespace signorini {
namespace {

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
      out.forces.on_face[n][k][0] -= part * outer.load[k][0];
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
  out.forces.in_element.resize(problem.element.size() * (D + 1));
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
      out.forces.in_element[Offset{e} * (D + 1) + a] += share;
      out.work[e] += std::fabs(share) * gap[k - first];
    }
  }
}

/// On faces: a linear pressure, and linear tractions of friction.
template <int D, int B>
void press_on_faces(const TrueProblem<D, B>& problem, const Gaps<D, B>& gaps, const AtVertices<D, B>& at,
                    const std::vector<double>& force, const Bounded<D, B>& distance, Contact<D, B>& out) {
  std::vector<double> area(force.size());
  for (const Index n : gaps.faces)
    for (const Index v : face_vertices<D>(problem.mesh, problem.incidence.sides[problem.outer[n].face]))
      area[v] += length<D>(problem.outer[n].normal) / D;
  out.forces.on_face.resize(problem.outer.size());
  const Tractions<D, B> friction(problem, gaps, at, force, area);
  for (const Index n : gaps.faces) {
    const OuterFace<D, B>& outer = problem.outer[n];
    const auto& sides = problem.incidence.sides[outer.face];
    const auto v = face_vertices<D>(problem.mesh, sides);
    const double measure = length<D>(outer.normal);
    std::array<double, D> p;
    for (int k = 0; k < D; ++k) p[k] = force[v[k]] / area[v[k]];
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m)
        if (const auto* bound = gaps.at_vertex(v[m]))
          for (int i = 0; i < B; ++i)
            out.forces.on_face[n][k][i] += measure * (1 + (k == m)) / (D * (D + 1)) * p[m] * bound->direction[i];
    out.work[sides.element[0]] += work_on_face<D, B>(problem, outer, v, p, distance);
    const auto bounded = [&](Index vertex) { return gaps.at_vertex(vertex) != nullptr; };
    if (!gaps.friction || !std::ranges::all_of(v, bounded)) continue;
    std::array<std::array<double, B>, D> t;
    for (int k = 0; k < D; ++k) t[k] = friction(v[k]);
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m)
        for (int i = 0; i < B; ++i) out.forces.on_face[n][k][i] += measure * (1 + (k == m)) / (D * (D + 1)) * t[m][i];
    const SlipWork work = friction.work(outer, v, edges_of_face(problem.mesh, problem.incidence, outer.face), t);
    out.work[sides.element[0]] += work.excess();
    out.friction += work.excess();
    out.friction_energy += work.most;
  }
}

}  // namespace

template <int D, int B>
Contact<D, B> contact_of(const TrueProblem<D, B>& problem, const Bubbles<D, B>& bubbles) {
  Contact<D, B> out;
  out.work.assign(problem.element.size(), 0);
  if (!problem.in_contact()) return out;
  const AtVertices<D, B> at(problem);
  const auto forces = forces_at_vertices(problem, at);
  for (std::size_t k = 0; k < problem.gaps.size(); ++k) {
    const Gaps<D, B>& gaps = problem.gaps[k];
    if (!gaps.any()) continue;
    const Bounded<D, B> distance(problem, gaps, bubbles);
    if (gaps.in_body)
      divide_in_body(problem, meet_loads_on_faces(problem, forces[k], distance, out), distance, out);
    else
      press_on_faces(problem, gaps, at, forces[k], distance, out);
  }
  if constexpr (B == D) press_between(problem, at, bubbles, out);
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B) template Contact<D, B> contact_of(const TrueProblem<D, B>&, const Bubbles<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
