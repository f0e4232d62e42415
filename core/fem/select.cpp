#include "core/fem/select.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "core/fem/element.hpp"
#include "core/mesh/boundary.hpp"

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

std::string describe(const Selection& selection) {
  if (!selection.where) return fmt::format("part '{}' has no boundary face", selection.part.value_or("boundary"));
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
Surface<D> surface(const Mesh<D>& mesh, std::vector<Index> faces) {
  // Per vertex: first how many faces are around it, then where the next of these goes.
  std::vector<Offset> next(mesh.points.size(), 0);
  for (const Index f : faces)
    for (const Index p : mesh.boundary[f].vertices) ++next[p];

  Surface<D> out;
  Offset sum = 0;
  for (Index p = 0; p < mesh.vertices(); ++p) {
    if (next[p] == 0) continue;
    out.vertices.push_back(p);
    out.first.push_back(sum);
    sum += std::exchange(next[p], sum);
  }
  out.first.push_back(sum);
  out.around.resize(static_cast<std::size_t>(sum));
  for (const Index f : faces)
    for (const Index p : mesh.boundary[f].vertices) out.around[next[p]++] = f;
  faces.swap(out.faces);
  return out;
}

template <int D>
Surface<D> surface(const Mesh<D>& mesh) {
  return surface(mesh, all_faces(mesh));
}

template <int D>
std::vector<Point<D>> vertex_normals(const Mesh<D>& mesh, const Surface<D>& surface) {
  std::vector<Point<D>> normals(surface.vertices.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    double measure = 0;
    Point<D> sum{};
    for (Offset k = surface.first[v]; k < surface.first[v + 1]; ++k) {
      const Point<D> n = area_normal(mesh, mesh.boundary[surface.around[k]]);
      for (int i = 0; i < D; ++i) sum[i] += n[i];
      measure += std::sqrt(dot(n, n));
    }
    if (normalise(sum) > 1e-12 * measure) normals[v] = sum;
  }
  return normals;
}

template <int D>
std::vector<double> vertex_areas(const Mesh<D>& mesh, const Surface<D>& surface) {
  std::vector<double> areas(surface.vertices.size());
  for (std::size_t v = 0; v < areas.size(); ++v)
    for (Offset k = surface.first[v]; k < surface.first[v + 1]; ++k) {
      const Point<D> n = area_normal(mesh, mesh.boundary[surface.around[k]]);
      areas[v] += std::sqrt(dot(n, n)) / D;
    }
  return areas;
}

template <int D>
std::vector<double> vertex_volumes(const Mesh<D>& mesh) {
  std::vector<double> volumes(mesh.points.size());
  for (const Simplex<D>& vertices : mesh.elements) {
    const double share = linear_element(mesh, vertices).measure / (D + 1);
    for (const Index p : vertices) volumes[p] += share;
  }
  return volumes;
}

#define SIGNORINI_INSTANTIATE(D)                                                       \
  template std::vector<Index> select_faces(const Mesh<D>&, const Selection&, double);  \
  template Surface<D> surface(const Mesh<D>&, std::vector<Index>);                     \
  template Surface<D> surface(const Mesh<D>&);                                         \
  template std::vector<Point<D>> vertex_normals<D>(const Mesh<D>&, const Surface<D>&); \
  template std::vector<double> vertex_areas(const Mesh<D>&, const Surface<D>&);        \
  template std::vector<double> vertex_volumes(const Mesh<D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
