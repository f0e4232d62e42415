#include "core/fem/elements/select.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {
namespace {

template <int D>
std::vector<Index> all_faces(const Mesh<D>& mesh) {
  std::vector<Index> faces(mesh.boundary.size());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

template <int D>
bool holds(const Mesh<D>& mesh, const Face<D>& face, const Field& where, double t) {
  Point<D> normal = area_normal(mesh, face);
  normalise(normal);
  return std::all_of(face.vertices.begin(), face.vertices.end(),
                     [&](Index p) { return where(site<D>(mesh.points[p], t, normal)) != 0; });
}

/// Keeps the faces that come from faces of the coarsest mesh where the expression holds.
template <int D>
void keep_where(const Mesh<D>& mesh, const Field& where, double t, std::vector<Index>& faces) {
  const Index children = faces_per_coarsest(mesh);
  Index last = -1;
  bool kept = false;
  std::erase_if(faces, [&](Index f) {
    if (const Index coarsest = f / children; std::exchange(last, coarsest) != coarsest)
      kept = holds(mesh, {.vertices = coarsest_face(mesh, coarsest), .element = -1}, where, t);
    return !kept;
  });
}

/// The mean over a simplex of its k-th basis function, times the circumference.
template <int D, std::size_t N>
double basis_integral(Plane plane, const Mesh<D>& mesh, const std::array<Index, N>& vertices, std::size_t k) {
  if (plane == Plane::axisymmetric) return hat_circumference<D>(plane, mesh, vertices, k);
  return basis_mean<1, static_cast<int>(N) - 1>(k);
}

std::string describe(const Selection& selection) {
  if (!selection.where)
    return fmt::format(
        "part '{}' has no boundary face (the axis of an axisymmetric body and planes of symmetry are no boundary)",
        selection.part.value_or("boundary"));
  return fmt::format(
      "no boundary face{} has all its vertices where '{}'; faces of the coarsest mesh are picked, which a smaller "
      "'size' or more 'cells' makes smaller",
      selection.part ? fmt::format(" of part '{}'", *selection.part) : "", selection.where->text());
}

}  // namespace

template <int D>
std::vector<Index> select_faces(const Mesh<D>& mesh, const Selection& selection, double t) {
  std::vector<Index> faces = selection.part ? faces_of(mesh, *selection.part, selection.origin) : all_faces(mesh);
  if (selection.where) keep_where(mesh, *selection.where, t, faces);
  if (faces.empty()) input_error(selection.origin, describe(selection));
  return faces;
}

template <int D>
Surface<D> surface(const Nodes<D>& nodes, std::vector<Index> faces) {
  // Per node: first how many faces are around it, then where the next of these goes.
  std::vector<Offset> next(static_cast<std::size_t>(nodes.size()), 0);
  for (const Index f : faces)
    for (const Index p : nodes.of_face(f)) ++next[p];

  Surface<D> out;
  Offset sum = 0;
  for (Index p = 0; p < nodes.size(); ++p) {
    if (next[p] == 0) continue;
    out.nodes.push_back(p);
    out.first.push_back(sum);
    sum += std::exchange(next[p], sum);
  }
  out.first.push_back(sum);
  out.around.resize(static_cast<std::size_t>(sum));
  for (const Index f : faces)
    for (const Index p : nodes.of_face(f)) out.around[next[p]++] = f;
  faces.swap(out.faces);
  return out;
}

template <int D>
Surface<D> surface(const Nodes<D>& nodes) {
  return surface(nodes, all_faces(nodes.mesh()));
}

template <int D>
std::vector<Point<D>> node_normals(const Nodes<D>& nodes, const Surface<D>& surface) {
  const Mesh<D>& mesh = nodes.mesh();
  std::vector<Point<D>> normals(surface.nodes.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    double measure = 0;
    Point<D> sum{};
    for (Offset k = surface.first[v]; k < surface.first[v + 1]; ++k) {
      const Point<D> n = area_normal(mesh, mesh.boundary[surface.around[k]]);
      for (int i = 0; i < D; ++i) sum[i] += n[i];
      measure += std::sqrt(dot(n, n));
    }
    keep_within<D>(mesh.mirrors, nodes.at(surface.nodes[v]), sum);
    if (normalise(sum) > rounding_of_differences * measure) normals[v] = sum;
  }
  return normals;
}

/// Where in its element's face the corner `at` of a face of the mesh is.
template <int D>
std::size_t place_on_element(const Nodes<D>& nodes, Index face, std::size_t at) {
  const auto per_element = static_cast<std::size_t>(nodes.faces_per_element());
  return static_cast<std::size_t>(RedRefinement<D - 1>::children[static_cast<std::size_t>(face) % per_element][at]);
}

/// The integral of the k-th quadratic basis function over a face of an element.
template <int D>
double quadratic_share(const Mesh<D>& mesh, const std::array<Index, element_nodes<D - 1, 2>>& vertices, std::size_t k,
                       Plane plane) {
  if (plane == Plane::axisymmetric)
    return ring_measure<2, D, D - 1>(mesh, vertices) * circumference_share<2, D, D - 1>(mesh, vertices, k);
  const ElementMap<D, D - 1, 2> map(mesh, vertices);
  const auto measure = [&](const auto& barycentric) { return length<D>(area_normal(map.flat(barycentric))); };
  if (!map.curved()) return measure(barycentre<D - 1>()) * basis_mean<2, D - 1>(k);
  double sum = 0;
  for (const auto& [barycentric, weight] : quadrature5<D - 1>())
    sum += weight * basis<2>(barycentric)[k] * measure(barycentric);
  return sum;
}

template <int D>
double face_measure(const Nodes<D>& nodes, Index face) {
  const Mesh<D>& mesh = nodes.mesh();
  const auto flat = [&](Index f) { return length<D>(area_normal(mesh, mesh.boundary[f])); };
  if (nodes.order() == 1) return flat(face);
  const Index first = face - face % nodes.faces_per_element();
  const ElementMap<D, D - 1, 2> map(mesh, nodes.template element_face<2>(first));
  if (!map.curved()) return flat(face);
  double curved = 0, facets = 0;
  for (const auto& [barycentric, weight] : quadrature5<D - 1>())
    curved += weight * length<D>(area_normal(map.flat(barycentric)));
  for (Index f = first; f < first + nodes.faces_per_element(); ++f) facets += flat(f);
  return flat(face) * curved / facets;
}

template <int D>
double face_share(const Nodes<D>& nodes, Index face, Index node, Plane plane) {
  const Mesh<D>& mesh = nodes.mesh();
  const auto all = nodes.of_face(face);
  const auto at = static_cast<std::size_t>(std::find(all.begin(), all.end(), node) - all.begin());
  if (nodes.order() == 1) {
    const Point<D> n = area_normal(mesh, mesh.boundary[face]);
    return std::sqrt(dot(n, n)) * basis_integral<D>(plane, mesh, mesh.boundary[face].vertices, at);
  }
  // Each corner of an element's face lies on one face of the mesh, each midpoint on as many as the face has corners.
  const std::size_t k = place_on_element(nodes, face, at);
  const auto vertices = nodes.template element_face<2>(face - face % nodes.faces_per_element());
  return quadratic_share(mesh, vertices, k, plane) / (k < D ? 1 : D);
}

template <int D, int P>
std::vector<SharePoint<D>> weighted_points(const Nodes<D>& nodes, Index face, std::size_t k, Plane plane) {
  const ElementMap<D, D - 1, P> map(nodes.mesh(), nodes.template element_face<P>(face));
  std::vector<SharePoint<D>> out;
  double whole = 0;
  for (const auto& [barycentric, weight] : quadrature5<D - 1>()) {
    const Point<D> x = map(barycentric);
    out.push_back({x, weight * basis<P>(barycentric)[k] * circumference<D>(plane, x)});
    whole += out.back().weight;
  }
  for (auto& point : out) point.weight /= whole;
  return out;
}

template <int D>
std::vector<SharePoint<D>> share_points(const Nodes<D>& nodes, Index face, Index node, Plane plane) {
  const auto all = nodes.of_face(face);
  const auto at = static_cast<std::size_t>(std::find(all.begin(), all.end(), node) - all.begin());
  auto out = nodes.order() == 1 ? weighted_points<D, 1>(nodes, face, at, plane)
                                : weighted_points<D, 2>(nodes, face - face % nodes.faces_per_element(),
                                                        place_on_element(nodes, face, at), plane);
  if (!std::isfinite(out.front().weight)) out = {{nodes.at(node), 1}};  // on the axis it stands for nothing
  return out;
}

template <int D>
std::vector<double> node_areas(const Nodes<D>& nodes, const Surface<D>& surface, Plane plane) {
  std::vector<double> areas(surface.nodes.size());
  for (std::size_t v = 0; v < areas.size(); ++v)
    for (Offset k = surface.first[v]; k < surface.first[v + 1]; ++k)
      areas[v] += face_share(nodes, surface.around[k], surface.nodes[v], plane);
  return areas;
}

template <int D>
std::vector<double> node_volumes(const Nodes<D>& nodes, Plane plane) {
  const Mesh<D>& mesh = nodes.mesh();
  std::vector<double> volumes(static_cast<std::size_t>(nodes.size()));
  if (nodes.order() == 2) {
    for (const Family<D>& family : mesh.families) {
      if (plane == Plane::axisymmetric) {
        const double ring = ring_measure<2, D, D>(mesh, family);
        for (std::size_t k = 0; k < family.size(); ++k)
          volumes[nodes.of_vertex(family[k])] += ring * circumference_share<2, D, D>(mesh, family, k);
        continue;
      }
      const ElementMap<D, D, 2> map(mesh, family);
      double measure = 0;
      for (const auto& [barycentric, weight] : stiffness_rule<D, 2>(!map.curved()))
        measure += weight * linear_element(map.flat(barycentric)).measure;
      for (std::size_t k = 0; k < family.size(); ++k)
        volumes[nodes.of_vertex(family[k])] += measure * basis_mean<2, D>(k);
    }
    return volumes;
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const double measure = signed_volume<D>(points_of(mesh, mesh.elements[e]));
    const auto node = nodes.of_simplex(e);
    for (std::size_t a = 0; a < node.size(); ++a)
      volumes[node[a]] += measure * basis_integral<D>(plane, mesh, mesh.elements[e], a);
  }
  return volumes;
}

#define SIGNORINI_INSTANTIATE(D)                                                             \
  template std::vector<Index> select_faces(const Mesh<D>&, const Selection&, double);        \
  template Surface<D> surface(const Nodes<D>&, std::vector<Index>);                          \
  template Surface<D> surface(const Nodes<D>&);                                              \
  template std::vector<Point<D>> node_normals<D>(const Nodes<D>&, const Surface<D>&);        \
  template double face_measure(const Nodes<D>&, Index);                                      \
  template double face_share(const Nodes<D>&, Index, Index, Plane);                          \
  template std::vector<SharePoint<D>> share_points<D>(const Nodes<D>&, Index, Index, Plane); \
  template std::vector<double> node_areas(const Nodes<D>&, const Surface<D>&, Plane);        \
  template std::vector<double> node_volumes(const Nodes<D>&, Plane);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
