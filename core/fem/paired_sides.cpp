#include "core/fem/paired_sides.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/select.hpp"

namespace signorini {
namespace {

/// What is left of a normal of less than this length is rounding.
constexpr double rounding = 1e-6;

template <int D>
std::vector<std::array<Index, D>> corners(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  std::vector<std::array<Index, D>> out;
  out.reserve(faces.size());
  for (const Index f : faces) out.push_back(mesh.boundary[f].vertices);
  return out;
}

/// Diagonal of the box around the mesh.
template <int D>
double extent(const Mesh<D>& mesh) {
  double square = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const auto [low, high] = std::ranges::minmax(mesh.points, {}, [i](const Point<D>& x) { return x[i]; });
    square += (high[i] - low[i]) * (high[i] - low[i]);
  }
  return std::sqrt(square);
}

}  // namespace

template <int D>
PairedFaces paired_faces(const Mesh<D>& mesh, const ObstacleTerm<D>& term, double t) {
  return {select_faces(mesh, *term.on, t), select_faces(mesh, *term.other, t)};
}

template <int D>
MortarCoupling<D> couple_sides(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                               const std::vector<Index>& slave, const std::vector<Index>& master) {
  const Mesh<D>& mesh = nodes.mesh();
  const auto of_slave = corners(mesh, slave), of_master = corners(mesh, master);
  return couple<D>(
      {mesh.points, of_slave, term.origin, nodes.order()}, {mesh.points, of_master, term.origin, nodes.order()},
      {.pairing = term.pairing, .reach = extent(mesh), .axisymmetric = model.plane == Plane::axisymmetric});
}

template <int D>
const FixedDirections<D>* fixed_at(const std::vector<FixedDirections<D>>& fixes, Index node) {
  const auto found = std::ranges::lower_bound(fixes, node, {}, &FixedDirections<D>::vertex);
  return found != fixes.end() && found->vertex == node ? &*found : nullptr;
}

template <int D>
std::optional<FreeNormal<D>> free_normal(const std::vector<FixedDirections<D>>& fixes, Index node,
                                         const Point<D>& normal) {
  FreeNormal<D> out{normal};
  const FixedDirections<D>* fixed = fixed_at(fixes, node);
  if (!fixed) return out;
  for (int k = 0; k < fixed->count; ++k) {
    double along = 0;
    for (int i = 0; i < D; ++i) along += fixed->direction[k][i] * normal[i];
    for (int i = 0; i < D; ++i) out.direction[i] -= along * fixed->direction[k][i];
    out.prescribed += along * fixed->value[k];
  }
  out.part = std::sqrt(dot(out.direction, out.direction));
  if (fixed->count == D || !(out.part > rounding)) return {};
  for (double& c : out.direction) c /= out.part;
  return out;
}

template <int D>
double longest_edge(const Mesh<D>& mesh, const Face<D>& face) {
  double square = 0;
  for (const Index a : face.vertices)
    for (const Index b : face.vertices) {
      Point<D> edge = mesh.points[a];
      for (int i = 0; i < D; ++i) edge[i] -= mesh.points[b][i];
      square = std::max(square, dot(edge, edge));
    }
  return std::sqrt(square);
}

template const FixedDirections<2>* fixed_at(const std::vector<FixedDirections<2>>&, Index);
template const FixedDirections<3>* fixed_at(const std::vector<FixedDirections<3>>&, Index);
template std::optional<FreeNormal<2>> free_normal<2>(const std::vector<FixedDirections<2>>&, Index, const Point<2>&);
template std::optional<FreeNormal<3>> free_normal<3>(const std::vector<FixedDirections<3>>&, Index, const Point<3>&);
template double longest_edge(const Mesh<2>&, const Face<2>&);
template double longest_edge(const Mesh<3>&, const Face<3>&);
template PairedFaces paired_faces(const Mesh<2>&, const ObstacleTerm<2>&, double);
template PairedFaces paired_faces(const Mesh<3>&, const ObstacleTerm<3>&, double);
template MortarCoupling<2> couple_sides(const Nodes<2>&, const Model<2>&, const ObstacleTerm<2>&,
                                        const std::vector<Index>&, const std::vector<Index>&);
template MortarCoupling<3> couple_sides(const Nodes<3>&, const Model<3>&, const ObstacleTerm<3>&,
                                        const std::vector<Index>&, const std::vector<Index>&);

}  // namespace signorini
