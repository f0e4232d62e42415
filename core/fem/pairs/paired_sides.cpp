#include "core/fem/pairs/paired_sides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/pairs/added_gap.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/true_surface.hpp"

namespace signorini {
namespace {

/// What is left of a normal of less than this length is rounding.
constexpr double no_normal = 1e-6;
/// Along a normal it is at most so many times as deep as to the nearest face: those 60 degrees from opposite pair.
constexpr double along_normal = 2;
/// Depths of less than this part of the mesh are rounding.
constexpr double no_depth = 1e-9;
/// And overlaps of less than this part of a face's length.
constexpr double no_overlap = 1e-6;

template <int D>
std::vector<std::array<Index, D>> corners(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  std::vector<std::array<Index, D>> out;
  out.reserve(faces.size());
  for (const Index f : faces) out.push_back(mesh.boundary[f].vertices);
  return out;
}

/// Diagonal of the box around points.
template <int D>
double extent(std::span<const Point<D>> points) {
  double square = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const auto [low, high] = std::ranges::minmax(points, {}, [i](const Point<D>& x) { return x[i]; });
    square += (high[i] - low[i]) * (high[i] - low[i]);
  }
  return std::sqrt(square);
}

template <int D>
void refuse_twice(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& faces) {
  std::vector<Index> twice;
  std::ranges::set_intersection(faces.slave, faces.master, std::back_inserter(twice));
  if (twice.empty()) return;
  Point<D> middle{};
  for (const Index v : mesh.boundary[twice.front()].vertices)
    for (int i = 0; i < D; ++i) middle[i] += mesh.points[v][i] / D;
  input_error(term.origin, fmt::format("the face at ({:.6g}) is on both sides, of slave and master, as {} of {} are; "
                                       "expected two parts of the body that have no face in common",
                                       fmt::join(middle, ", "), twice.size(), faces.slave.size()));
}

/// The longest edge that faces of the coarsest mesh have there.
template <int D>
double coarsest_length(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  double longest = 0;
  for (const Index f : faces) longest = std::max(longest, longest_edge(mesh, mesh.boundary[f]));
  return std::ldexp(longest, mesh.refinements);
}

}  // namespace

template <int D>
PairedFaces paired_faces(const Mesh<D>& mesh, const ObstacleTerm<D>& term, double t) {
  PairedFaces out{select_faces(mesh, *term.on, t), select_faces(mesh, *term.other, t)};
  std::ranges::sort(out.slave);
  std::ranges::sort(out.master);
  refuse_twice(mesh, term, out);
  return out;
}

template <int D>
bool of_one_body(const ObstacleTerm<D>& term) {
  return body_of(term.on->part.value_or("")) == body_of(term.other->part.value_or(""));
}

template <int D>
std::vector<Index> faces_of_body(const Mesh<D>& mesh, const Selection& some, double t) {
  const std::string all = part_of(body_of(some.part.value_or("")), "boundary");
  std::vector<Index> faces = select_faces(mesh, {.part = all, .where = {}, .origin = some.origin}, t);
  std::ranges::sort(faces);
  return faces;
}

template <int D>
std::vector<Index> of_other_obstacles(const Mesh<D>& mesh, const Model<D>& model) {
  std::vector<Index> out;
  for (const ObstacleTerm<D>& term : model.obstacles) {
    if (term.other || !term.on) continue;
    for (const Index f : select_faces(mesh, *term.on, model.t))
      out.insert(out.end(), mesh.boundary[f].vertices.begin(), mesh.boundary[f].vertices.end());
  }
  return out;
}

template <int D>
std::optional<Overlap<D>> overlap_of_sides(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& sides,
                                           double t, std::span<const Point<D>> points,
                                           const std::function<double(const Point<D>&, Index)>& added) {
  if (of_one_body(term)) return {};
  std::vector<Index> slave = faces_of_body(mesh, *term.on, t), master = faces_of_body(mesh, *term.other, t);
  if (!std::ranges::binary_search(slave, sides.slave.front())) slave.swap(master);  // looked at the other way round
  return find_overlap<D>(mesh, points, {sides.slave, std::move(slave)}, {sides.master, std::move(master)}, added);
}

template <int D>
double added_on_face(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const Point<D>& place, Index slave_face) {
  Point<D> normal = area_normal(mesh, mesh.boundary[slave_face]);
  normalise(normal);
  return added_gap<D>(term, place, normal);
}

template <int D>
std::optional<Overlap<D>> start_overlap(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& sides,
                                        double t) {
  return overlap_of_sides<D>(mesh, term, sides, t, mesh.points, [&](const Point<D>& place, Index slave_face) {
    return added_on_face<D>(mesh, term, place, slave_face);
  });
}

namespace {

/// How far the flat faces of one side are off the surfaces that they stand for: there they may overlap, and bodies not.
template <int D>
double off_surfaces(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  std::array<double, D> middle;
  middle.fill(1.0 / D);
  double most = 0;
  for (const Index f : faces) {
    if (!stands_for_surface(mesh, f)) continue;
    Point<D> normal = area_normal(mesh, mesh.boundary[f]);
    normalise(normal);
    most = std::max(most, std::abs(surface_at<D>(mesh, f, middle, normal).height));
  }
  return most;
}

}  // namespace

template <int D>
void refuse_unseen_overlap(const Nodes<D>& nodes, const Model<D>& model) {
  const Mesh<D>& mesh = nodes.mesh();
  for (const ObstacleTerm<D>& term : model.obstacles) {
    if (!term.other) continue;
    const PairedFaces faces = paired_faces(mesh, term, model.t);
    const auto start = start_overlap(mesh, term, faces, model.t);
    if (!start || start->slave_face < 0) continue;
    if (start->depth <= no_overlap * longest_edge(mesh, mesh.boundary[start->slave_face]) +
                            off_surfaces(mesh, faces.slave) + off_surfaces(mesh, faces.master))
      continue;
    if (couple_sides<D>(nodes, model, term, faces.slave, faces.master).deepest.slave_face >= 0) continue;
    input_error(
        term.origin,
        fmt::format("the bodies overlap at the start, by {:.4g} at ({:.6g}), and no faces there are opposite to "
                    "each other: nothing would keep one out of the other; expected bodies apart from each "
                    "other, or the faces that meet there ('on', 'other_on')",
                    start->depth, fmt::join(start->place, ", ")));
  }
}

template <int D>
MortarCoupling<D> couple_sides(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                               const std::vector<Index>& slave, const std::vector<Index>& master,
                               std::span<const Point<D>> points, std::span<const Index> left_out) {
  const Mesh<D>& mesh = nodes.mesh();
  if (points.empty()) points = mesh.points;
  const auto of_slave = corners(mesh, slave), of_master = corners(mesh, master);
  CoupleOptions options{
      .pairing = term.pairing, .reach = extent<D>(points), .axisymmetric = model.plane == Plane::axisymmetric};
  if (const auto overlap = overlap_of_sides<D>(mesh, term, {slave, master}, model.t, points))
    options.depth = along_normal * overlap->depth + no_depth * options.reach;
  else if (!term.resolve)
    options.depth = coarsest_length(mesh, slave);
  const std::vector<double> added = added_gaps(nodes, term, slave);
  options.added_gap = added;
  options.left_out = left_out;
  return couple<D>({points, of_slave, term.origin, nodes.order(), &mesh, slave},
                   {points, of_master, term.origin, nodes.order(), &mesh, master}, options);
}

template <int D>
std::optional<double> prescribed_along(const std::vector<FixedDirections<D>>& fixes, Index node,
                                       const double* direction) {
  const FixedDirections<D>* fixed = fixed_at(fixes, node);
  if (!fixed) return {};
  double left = 1, value = 0;
  for (int i = 0; i < fixed->count; ++i) {
    double along = 0;
    for (int m = 0; m < D; ++m) along += direction[m] * fixed->direction[i][m];
    left -= along * along;
    value += along * fixed->value[i];
  }
  return left <= no_normal ? std::optional(value) : std::nullopt;
}

namespace {

/// What is prescribed of the master in front of places of the slave: a node of that may be prescribed to move along
/// with it there, as on a plane of symmetry by fixes, though not with what it sees of the master in the mean.
template <int D>
class PrescribedMaster {
 public:
  /// Keeps references.
  PrescribedMaster(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes,
                   std::span<const Point<D>> points, const std::vector<Index>& faces)
      : nodes_(nodes), fixes_(fixes), points_(points) {
    std::ranges::copy_if(faces, std::back_inserter(faces_), [&](Index f) {
      return std::ranges::any_of(nodes.mesh().boundary[f].vertices,
                                 [&](Index v) { return fixed_at(fixes, nodes.of_vertex(v)) != nullptr; });
    });
  }

  /// Whether what a vertex of the slave sees along its normal is prescribed to move as far along a direction.
  bool goes_along(Index vertex, const Point<D>& normal, const double* direction, double value) const {
    return std::ranges::any_of(faces_, [&](Index f) {
      const Face<D>& face = nodes_.mesh().boundary[f];
      const Point<D> opposite = area_normal(nodes_.mesh(), face);
      if (!(dot(opposite, normal) < -0.5 * length<D>(opposite))) return false;
      const std::array<double, D> place = seen_along(face, points_[vertex], normal);
      double there = 0, size = std::abs(value);
      for (int i = 0; i < D; ++i) {
        if (place[i] < -no_normal) return false;
        if (place[i] <= no_normal) continue;
        const auto fixed = prescribed_along(fixes_, nodes_.of_vertex(face.vertices[i]), direction);
        if (!fixed) return false;
        there += place[i] * *fixed;
        size = std::max(size, std::abs(*fixed));
      }
      return std::abs(there - value) <= no_normal * size;
    });
  }

 private:
  /// The barycentric coordinates of where the line through a point meets the plane of a face.
  std::array<double, D> seen_along(const Face<D>& face, const Point<D>& x, const Point<D>& normal) const {
    const Point<D>& origin = points_[face.vertices[0]];
    std::array<Point<D>, D> rows;
    for (int i = 1; i < D; ++i) rows[i - 1] = difference<D>(points_[face.vertices[i]], origin);
    rows[D - 1] = normal;
    const double all = determinant<D>(rows);
    std::array<double, D> out{1};
    for (int i = 1; i < D; ++i) {
      auto other = rows;
      other[i - 1] = difference<D>(x, origin);
      out[i] = determinant<D>(other) / all;
      out[0] -= out[i];
    }
    return out;
  }

  const Nodes<D>& nodes_;
  const std::vector<FixedDirections<D>>& fixes_;
  std::span<const Point<D>> points_;
  std::vector<Index> faces_;  // with nodes of which something is prescribed
};

/// The slave's vertices where a fix, not a plane of symmetry, prescribes something that the master does not go along
/// with; ascending.
template <int D>
std::vector<Index> held_apart(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes,
                              std::span<const Point<D>> points, const std::vector<Index>& master,
                              const MortarCoupling<D>& coupling) {
  std::vector<Index> out;
  if (fixes.empty()) return out;
  const PrescribedMaster<D> other(nodes, fixes, points.empty() ? nodes.mesh().points : points, master);
  for (Index k = 0; k < coupling.nodes(); ++k) {
    const Index p = nodes.of_vertex(coupling.node[k]);
    const FixedDirections<D>* fixed = fixed_at(fixes, p);
    if (!fixed) continue;
    const auto free = free_normal<D>(fixes, p, coupling.normal[k]);
    const Point<D>& normal = free ? free->direction : coupling.normal[k];
    bool apart = false;
    for (int i = 0; i < fixed->count; ++i)
      apart = apart ||
              (fixed->fix[i] >= 0 && !other.goes_along(coupling.node[k], normal, fixed->direction[i], fixed->value[i]));
    if (apart) out.push_back(coupling.node[k]);
  }
  return out;
}

/// Those of some vertices, ascending, that are on these faces.
template <int D>
std::vector<Index> on_faces(const Mesh<D>& mesh, const std::vector<Index>& faces, const std::vector<Index>& some) {
  std::vector<Index> out;
  for (const Index f : faces)
    for (const Index v : mesh.boundary[f].vertices)
      if (std::ranges::binary_search(some, v)) out.push_back(v);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Those of some vertices, ascending, that are on no face of an element all of whose vertices are among them.
/// @param faces those of quadratic elements follow each other in parts
template <int D>
std::vector<Index> with_neighbours(const Nodes<D>& nodes, const std::vector<Index>& faces, std::vector<Index> some) {
  const auto parts = static_cast<std::size_t>(nodes.faces_per_element());
  const auto among = [&](Index v) { return std::ranges::binary_search(some, v); };
  std::vector<Index> alone, corners;
  for (std::size_t first = 0; first < faces.size(); first += parts) {
    corners.clear();
    for (std::size_t k = first; k < first + parts; ++k)
      corners.insert(corners.end(), nodes.mesh().boundary[faces[k]].vertices.begin(),
                     nodes.mesh().boundary[faces[k]].vertices.end());
    if (std::ranges::all_of(corners, among)) alone.insert(alone.end(), corners.begin(), corners.end());
  }
  std::ranges::sort(alone);
  std::erase_if(some, [&](Index v) { return std::ranges::binary_search(alone, v); });
  return some;
}

}  // namespace

template <int D>
MortarCoupling<D> couple_beside(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                                const PairedFaces& faces, std::span<const Point<D>> points,
                                const std::vector<Index>& left_out) {
  const std::vector<Index> some = with_neighbours(nodes, faces.slave, on_faces(nodes.mesh(), faces.slave, left_out));
  return couple_sides<D>(nodes, model, term, faces.slave, faces.master, points, some);
}

template <int D>
MortarCoupling<D> couple_whole_jumps(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                                     const PairedFaces& faces, const std::vector<FixedDirections<D>>& fixes,
                                     std::span<const Point<D>> points, const std::vector<Index>& left_out,
                                     Index* lost) {
  MortarCoupling<D> found = couple_sides<D>(nodes, model, term, faces.slave, faces.master, points);
  const std::vector<Index> apart = held_apart<D>(nodes, fixes, points, faces.master, found);
  std::vector<Index> all;
  std::ranges::set_union(apart, on_faces(nodes.mesh(), faces.slave, left_out), std::back_inserter(all));
  all = with_neighbours(nodes, faces.slave, std::move(all));
  if (lost) *lost = static_cast<Index>(apart.size() - all.size());
  return all.empty() ? std::move(found) : couple_sides<D>(nodes, model, term, faces.slave, faces.master, points, all);
}

template <int D>
std::vector<Point<D>> displaced_points(const Nodes<D>& nodes, const std::vector<double>& u) {
  std::vector<Point<D>> points = nodes.mesh().points;
  const std::vector<double> by = nodes.at_vertices(u, D);
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t i = 0; i < D; ++i) points[v][i] += by[v * D + i];
  return points;
}

template <int D>
MortarCoupling<D> couple_displaced(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                   const std::vector<double>& u) {
  const ObstacleTerm<D>& term = model.obstacles[obstacle];
  const PairedFaces faces = paired_faces(nodes.mesh(), term, model.t);
  return couple_sides<D>(nodes, model, term, faces.slave, faces.master, displaced_points(nodes, u));
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
  if (fixed->count == D || !(out.part > no_normal)) return {};
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

template double added_on_face<2>(const Mesh<2>&, const ObstacleTerm<2>&, const Point<2>&, Index);
template double added_on_face<3>(const Mesh<3>&, const ObstacleTerm<3>&, const Point<3>&, Index);
template std::optional<Overlap<2>> start_overlap(const Mesh<2>&, const ObstacleTerm<2>&, const PairedFaces&, double);
template std::optional<Overlap<3>> start_overlap(const Mesh<3>&, const ObstacleTerm<3>&, const PairedFaces&, double);
template void refuse_unseen_overlap(const Nodes<2>&, const Model<2>&);
template void refuse_unseen_overlap(const Nodes<3>&, const Model<3>&);
template MortarCoupling<2> couple_displaced(const Nodes<2>&, const Model<2>&, Index, const std::vector<double>&);
template MortarCoupling<3> couple_displaced(const Nodes<3>&, const Model<3>&, Index, const std::vector<double>&);
template std::optional<double> prescribed_along(const std::vector<FixedDirections<2>>&, Index, const double*);
template std::optional<double> prescribed_along(const std::vector<FixedDirections<3>>&, Index, const double*);
template const FixedDirections<2>* fixed_at(const std::vector<FixedDirections<2>>&, Index);
template const FixedDirections<3>* fixed_at(const std::vector<FixedDirections<3>>&, Index);
template std::optional<FreeNormal<2>> free_normal<2>(const std::vector<FixedDirections<2>>&, Index, const Point<2>&);
template std::optional<FreeNormal<3>> free_normal<3>(const std::vector<FixedDirections<3>>&, Index, const Point<3>&);
template double longest_edge(const Mesh<2>&, const Face<2>&);
template double longest_edge(const Mesh<3>&, const Face<3>&);
template std::vector<Index> of_other_obstacles(const Mesh<2>&, const Model<2>&);
template std::vector<Index> of_other_obstacles(const Mesh<3>&, const Model<3>&);
template bool of_one_body(const ObstacleTerm<2>&);
template bool of_one_body(const ObstacleTerm<3>&);
template std::vector<Index> faces_of_body(const Mesh<2>&, const Selection&, double);
template std::vector<Index> faces_of_body(const Mesh<3>&, const Selection&, double);
template std::optional<Overlap<2>> overlap_of_sides<2>(const Mesh<2>&, const ObstacleTerm<2>&, const PairedFaces&,
                                                       double, std::span<const Point<2>>,
                                                       const std::function<double(const Point<2>&, Index)>&);
template std::optional<Overlap<3>> overlap_of_sides<3>(const Mesh<3>&, const ObstacleTerm<3>&, const PairedFaces&,
                                                       double, std::span<const Point<3>>,
                                                       const std::function<double(const Point<3>&, Index)>&);
template PairedFaces paired_faces(const Mesh<2>&, const ObstacleTerm<2>&, double);
template PairedFaces paired_faces(const Mesh<3>&, const ObstacleTerm<3>&, double);
template MortarCoupling<2> couple_sides<2>(const Nodes<2>&, const Model<2>&, const ObstacleTerm<2>&,
                                           const std::vector<Index>&, const std::vector<Index>&,
                                           std::span<const Point<2>>, std::span<const Index>);
template MortarCoupling<2> couple_beside<2>(const Nodes<2>&, const Model<2>&, const ObstacleTerm<2>&,
                                            const PairedFaces&, std::span<const Point<2>>, const std::vector<Index>&);
template MortarCoupling<2> couple_whole_jumps<2>(const Nodes<2>&, const Model<2>&, const ObstacleTerm<2>&,
                                                 const PairedFaces&, const std::vector<FixedDirections<2>>&,
                                                 std::span<const Point<2>>, const std::vector<Index>&, Index*);
template MortarCoupling<3> couple_sides<3>(const Nodes<3>&, const Model<3>&, const ObstacleTerm<3>&,
                                           const std::vector<Index>&, const std::vector<Index>&,
                                           std::span<const Point<3>>, std::span<const Index>);
template MortarCoupling<3> couple_beside<3>(const Nodes<3>&, const Model<3>&, const ObstacleTerm<3>&,
                                            const PairedFaces&, std::span<const Point<3>>, const std::vector<Index>&);
template MortarCoupling<3> couple_whole_jumps<3>(const Nodes<3>&, const Model<3>&, const ObstacleTerm<3>&,
                                                 const PairedFaces&, const std::vector<FixedDirections<3>>&,
                                                 std::span<const Point<3>>, const std::vector<Index>&, Index*);
template std::vector<Point<2>> displaced_points<2>(const Nodes<2>&, const std::vector<double>&);
template std::vector<Point<3>> displaced_points<3>(const Nodes<3>&, const std::vector<double>&);

}  // namespace signorini
