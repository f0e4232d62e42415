#include "apps/bench/friction/friction_law.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace signorini::bench {
namespace {

constexpr double moved = 1e-8;  // of the largest displacement: what moves less sticks, what is farther off is open

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

template <int D>
Vector<D> vector_of(const Point<D>& p) {
  return Vector<D>(p.data());
}

template <int D>
Vector<D> at(const std::vector<double>& u, Index vertex) {
  return Vector<D>(u.data() + Offset{vertex} * D);
}

template <int D>
struct Nodal {
  std::vector<Vector<D>> force;

  explicit Nodal(const Mesh<D>& mesh) : force(mesh.points.size(), Vector<D>::Zero()) {}
  Vector<D>& operator[](Index vertex) { return force[static_cast<std::size_t>(vertex)]; }
};

/// Adds what the stresses of an element ask for at its vertices: volume times stress times gradient of the hat.
template <int D>
void add_stress(const Mesh<D>& mesh, const std::array<Index, D + 1>& element, double lambda, double shear,
                const std::vector<double>& u, Nodal<D>& out) {
  Eigen::Matrix<double, D, D> edges, motions;
  for (int k = 0; k < D; ++k) {
    edges.col(k) = vector_of<D>(mesh.points[element[k + 1]]) - vector_of<D>(mesh.points[element[0]]);
    motions.col(k) = at<D>(u, element[k + 1]) - at<D>(u, element[0]);
  }
  const Eigen::Matrix<double, D, D> inverse = edges.inverse(), gradient = motions * inverse;
  const Eigen::Matrix<double, D, D> stress =
      lambda * gradient.trace() * Eigen::Matrix<double, D, D>::Identity() + shear * (gradient + gradient.transpose());
  const double volume = std::abs(edges.determinant()) / (D == 2 ? 2 : 6);
  Vector<D> sum = Vector<D>::Zero();
  for (int k = 0; k < D; ++k) {
    const Vector<D> force = volume * stress * inverse.row(k).transpose();
    out[element[k + 1]] += force;
    sum += force;
  }
  out[element[0]] -= sum;
}

template <int D>
const std::vector<Index>& faces_of(const Mesh<D>& mesh, const std::string& part) {
  return std::ranges::find(mesh.parts, part, &Part::name)->faces;
}

template <int D>
double area(const Mesh<D>& mesh, const Face<D>& face) {
  const Vector<D> a = vector_of<D>(mesh.points[face.vertices[1]]) - vector_of<D>(mesh.points[face.vertices[0]]);
  if constexpr (D == 2)
    return a.norm();
  else
    return 0.5 *
           a.cross(vector_of<D>(mesh.points[face.vertices[2]]) - vector_of<D>(mesh.points[face.vertices[0]])).norm();
}

template <int D>
std::vector<char> vertices_of(const Mesh<D>& mesh, const std::vector<std::string>& parts) {
  std::vector<char> out(mesh.points.size(), 0);
  for (const std::string& part : parts)
    for (const Index face : faces_of(mesh, part))
      for (const Index vertex : mesh.boundary[face].vertices) out[vertex] = 1;
  return out;
}

/// What has to act on the vertices besides the loads.
template <int D>
Nodal<D> demanded(const Mesh<D>& mesh, double young, double poisson, const std::vector<Traction<D>>& loads,
                  const std::vector<double>& u) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = 0.5 * young / (1 + poisson);
  Nodal<D> out(mesh);
  for (const auto& element : mesh.elements) add_stress<D>(mesh, element, lambda, shear, u, out);
  for (const Traction<D>& load : loads)
    for (const Index face : faces_of(mesh, load.part))
      for (const Index vertex : mesh.boundary[face].vertices)
        out[vertex] -= area<D>(mesh, mesh.boundary[face]) / D * vector_of<D>(load.value);
  return out;
}

/// A vertex against one plane: by how much the law is violated, a force.
template <int D>
double judge(const RoughPlane<D>& plane, const Vector<D>& force, const Vector<D>& slip, double gap, double size,
             LawViolation& out) {
  const Vector<D> n = vector_of<D>(plane.normal);
  out.penetration = std::max(out.penetration, -gap / size);
  if (gap > moved * size) {
    ++out.open;
    return force.norm();
  }
  const double pressing = force.dot(n), bound = plane.friction * std::max(pressing, 0.0);
  const Vector<D> across = force - pressing * n;
  const double pulls = std::max(-pressing, 0.0);
  if (slip.norm() <= moved * size) {
    ++out.sticking;
    return std::max(pulls, across.norm() - bound);
  }
  ++out.slipping;
  return std::max(pulls, (across + bound / slip.norm() * slip).norm());
}

}  // namespace

double LawViolation::worst() const { return std::max(force, penetration); }

template <int D>
LawViolation law_violation(const Mesh<D>& mesh, double young, double poisson, const std::vector<RoughPlane<D>>& planes,
                           const std::vector<Traction<D>>& loads, const std::vector<std::string>& fixed,
                           const std::vector<double>& u, const std::vector<double>& last) {
  Nodal<D> forces = demanded<D>(mesh, young, poisson, loads, u);
  const std::vector<char> held = vertices_of<D>(mesh, fixed);
  std::vector<char> judged = held;
  double size = 0, largest = 0, worst = 0;
  for (const double value : u) size = std::max(size, std::abs(value));
  LawViolation out;
  for (const RoughPlane<D>& plane : planes) {
    const Vector<D> n = vector_of<D>(plane.normal);
    const std::vector<char> touched = vertices_of<D>(mesh, {plane.part});
    for (Index v = 0; v < mesh.vertices(); ++v) {
      if (!touched[v] || held[v]) continue;
      judged[v] = 1;
      const Vector<D> motion = at<D>(u, v) - at<D>(last, v), slip = motion - motion.dot(n) * n;
      const double gap = (vector_of<D>(mesh.points[v]) - vector_of<D>(plane.point) + at<D>(u, v)).dot(n);
      largest = std::max(largest, forces[v].norm());
      worst = std::max(worst, judge<D>(plane, forces[v], slip, gap, size, out));
    }
  }
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (!judged[v]) worst = std::max(worst, forces[v].norm());
  out.force = largest > 0 ? worst / largest : worst;
  return out;
}

template LawViolation law_violation<2>(const Mesh<2>&, double, double, const std::vector<RoughPlane<2>>&,
                                       const std::vector<Traction<2>>&, const std::vector<std::string>&,
                                       const std::vector<double>&, const std::vector<double>&);
template LawViolation law_violation<3>(const Mesh<3>&, double, double, const std::vector<RoughPlane<3>>&,
                                       const std::vector<Traction<3>>&, const std::vector<std::string>&,
                                       const std::vector<double>&, const std::vector<double>&);

}  // namespace signorini::bench
