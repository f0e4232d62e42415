// Preconditions of the kernel that a segment, and a triangle of the surface, are no points or lines: exact arithmetic
// for every triangle in the coordinate planes, at every crossing. The reader has dropped such triangles.
#define CGAL_KERNEL_NO_PRECONDITIONS

#include "core/geometry/cgal/triangle_surface.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_3/Robust_intersection_traits_3.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <map>

#include "core/geometry/cgal/checks.hpp"
#include "core/io/surface_reader.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>;
// Exact constructions, rounded once: a segment that leaves a plane under a tiny angle crosses it anywhere otherwise,
// even beyond its own ends. Segments within the plane of a triangle do not cross it.
using CrossingKernel = CGAL::Mesh_3::Robust_intersection_traits_3_new<Kernel>;
using AABBTree = CGAL::AABB_tree<CGAL::AABB_traits<CrossingKernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel, CGAL::Default, AABBTree>;

Kernel::Point_3 cgal(const Point<3>& p) { return {p[0], p[1], p[2]}; }
Point<3> plain(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

void read(const std::string& file, SurfaceMesh& mesh) {
  PolygonSoup soup = read_surface(file);
  auto& polygons = soup.faces;
  std::vector<Kernel::Point_3> points;
  std::transform(soup.points.begin(), soup.points.end(), std::back_inserter(points), cgal);
  PMP::repair_polygon_soup(points, polygons);
  PMP::orient_polygon_soup(points, polygons);
  if (polygons.empty()) input_error(file, "all faces are degenerate; expected a triangle surface");
  if (!PMP::is_polygon_soup_a_polygon_mesh(polygons)) input_error(file, "the faces do not form a surface");
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
}

/// A descent into the tree that takes what is within a shrinking reach.
class Approach {
 public:
  using Node = CGAL::AABB_node<CGAL::AABB_traits<CrossingKernel, Primitive>>;
  using Priority = double;

  explicit Approach(const std::function<double(Index)>& visit) : visit_(visit) {}

  static constexpr bool go_further() { return true; }
  void intersection(const Point<3>&, const Primitive& primitive) {
    reach_ = visit_(static_cast<Index>(primitive.id()));
  }
  bool do_intersect(const Point<3>& p, const Node& node) const { return distance(p, node) <= reach_; }
  std::pair<bool, double> do_intersect_with_priority(const Point<3>& p, const Node& node) const {
    const double d = distance(p, node);
    return {d <= reach_, -d};
  }

 private:
  static double distance(const Point<3>& p, const Node& node) {
    const CGAL::Bbox_3& box = node.bbox();
    Point<3> outside;
    for (int k = 0; k < 3; ++k) outside[k] = std::max({box.min(k) - p[k], p[k] - box.max(k), 0.0});
    return length<3>(outside);
  }

  const std::function<double(Index)>& visit_;
  double reach_ = infinity;
};

}  // namespace

namespace {

/// A connected part of a closed surface, oriented outwards.
class Shell {
 public:
  Shell(const SurfaceMesh& whole, const std::vector<SurfaceMesh::Face_index>& faces) {
    std::map<SurfaceMesh::Vertex_index, SurfaceMesh::Vertex_index> own;
    for (const auto f : faces) {
      std::vector<SurfaceMesh::Vertex_index> corners;
      for (const auto v : whole.vertices_around_face(whole.halfedge(f))) {
        if (!own.contains(v)) own[v] = mesh_.add_vertex(whole.point(v));
        corners.push_back(own[v]);
      }
      mesh_.add_face(corners);
    }
    tree_.insert(mesh_.faces_begin(), mesh_.faces_end(), mesh_);
    tree_.build();
    box_ = tree_.bbox();
    side_.emplace(tree_);
  }

  bool may_meet(const Shell& other) const { return CGAL::do_overlap(box_, other.box_); }
  bool holds(const Kernel::Point_3& p) const { return (*side_)(p) == CGAL::ON_BOUNDED_SIDE; }
  /// Whether all of another one is inside. It may touch this one.
  bool holds(const Shell& other) const {
    bool any = false;
    for (const auto v : other.mesh_.vertices()) {
      const auto where = (*side_)(other.mesh_.point(v));
      if (where == CGAL::ON_UNBOUNDED_SIDE) return false;
      any = any || where == CGAL::ON_BOUNDED_SIDE;
    }
    return any;
  }

  int sign = 1;  ///< -1: it bounds a cavity

 private:
  SurfaceMesh mesh_;
  AABBTree tree_;
  CGAL::Bbox_3 box_;
  std::optional<Side> side_;
};

using Shells = std::vector<std::unique_ptr<Shell>>;

/// Orients each connected part of a closed surface by what is inside it: outwards, those within others inwards,
/// outwards, and so on in turns. Parts that cross each other bound what is inside of any.
/// @return the parts; none where no two of their boxes overlap
Shells orient_outwards(SurfaceMesh& mesh) {
  const auto part = mesh.add_property_map<SurfaceMesh::Face_index, std::size_t>("f:part").first;
  std::vector<std::vector<SurfaceMesh::Face_index>> faces(PMP::connected_components(mesh, part));
  for (const auto f : mesh.faces()) faces[part[f]].push_back(f);
  for (const auto& of_part : faces) {
    double volume = 0;
    const Kernel::Point_3 origin = mesh.point(mesh.target(mesh.halfedge(of_part[0])));
    for (const auto f : of_part) {
      std::array<Kernel::Vector_3, 3> corner;
      auto h = mesh.halfedge(f);
      for (auto& x : corner) x = mesh.point(mesh.target(h)) - origin, h = mesh.next(h);
      volume += CGAL::determinant(corner[0], corner[1], corner[2]);
    }
    if (volume < 0) PMP::reverse_face_orientations(of_part, mesh);
  }
  Shells shells;
  if (faces.size() == 1) return shells;
  for (const auto& of_part : faces) shells.push_back(std::make_unique<Shell>(mesh, of_part));
  bool meet = false;
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t k = 0; k < shells.size(); ++k) {
      if (i == k || !shells[i]->may_meet(*shells[k])) continue;
      meet = true;
      if (shells[k]->holds(*shells[i])) shells[i]->sign = -shells[i]->sign;
    }
  for (std::size_t i = 0; i < shells.size(); ++i)
    if (shells[i]->sign < 0) PMP::reverse_face_orientations(faces[i], mesh);
  if (!meet) shells.clear();
  return shells;
}

}  // namespace

struct TriangleSurface::Tree {
  SurfaceMesh mesh;
  AABBTree aabb;
  std::optional<Side> side;
  Shells shells;  // none: `side` tells the inside
};

TriangleSurface::TriangleSurface(const std::string& file, Coordinates coordinates)
    : file_(file), tree_(std::make_unique<Tree>()) {
  SurfaceMesh& mesh = tree_->mesh;
  read(file, mesh);
  for (const auto v : mesh.vertices()) given_points_.push_back(plain(mesh.point(v)));
  points_ = given_points_;
  units_ = own_units<3>(given_points_);
  if (coordinates == Coordinates::centred) units_ = {units_.given({0.5, 0.5, 0.5}), 1};
  for (Point<3>& p : points_)
    p = coordinates == Coordinates::own ? units_.own(p, surface_digits) : difference<3>(p, units_.origin);
  for (const auto v : mesh.vertices()) mesh.point(v) = cgal(points_[v.idx()]);
  if (!PMP::triangulate_faces(mesh)) input_error(file, "a face cannot be divided into triangles; expected triangles");
  closed_ = CGAL::is_closed(mesh);
  if (closed_) tree_->shells = orient_outwards(mesh);

  for (const auto f : mesh.faces()) {
    auto& triangle = triangles_.emplace_back();
    auto& neighbour = neighbours_.emplace_back();
    auto h = mesh.halfedge(f);
    for (std::size_t k = 0; k < 3; ++k, h = mesh.next(h)) {  // h ends at vertex k + 1, opposite to vertex k - 1
      triangle[(k + 1) % 3] = static_cast<Index>(mesh.target(h));
      const auto other = mesh.face(mesh.opposite(h));
      neighbour[(k + 2) % 3] = other == SurfaceMesh::null_face() ? -1 : static_cast<Index>(other);
    }
  }
  tree_->aabb.insert(mesh.faces_begin(), mesh.faces_end(), mesh);
  tree_->aabb.build();
  tree_->aabb.accelerate_distance_queries();
  if (closed_) tree_->side.emplace(tree_->aabb);
}

TriangleSurface::~TriangleSurface() = default;

Box TriangleSurface::box() const {
  const CGAL::Bbox_3 b = tree_->aabb.bbox();
  return {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}};
}

std::size_t TriangleSurface::border_edges() const {
  std::size_t count = 0;
  for (const auto& n : neighbours_) count += static_cast<std::size_t>(std::count(n.begin(), n.end(), -1));
  return count;
}

std::vector<std::size_t> TriangleSurface::nesting() const {
  SurfaceMesh mesh = tree_->mesh;
  std::vector<std::size_t> levels;
  const auto volume = mesh.add_property_map<SurfaceMesh::Face_index, std::size_t>("f:volume").first;
  PMP::volume_connected_components(mesh, volume,
                                   CGAL::parameters::nesting_levels(std::ref(levels)).do_orientation_tests(false));
  return levels;
}

std::optional<std::pair<Index, Index>> TriangleSurface::self_intersection() const {
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  PMP::self_intersections<CGAL::Sequential_tag>(tree_->mesh, std::back_inserter(pairs));
  if (pairs.empty()) return {};
  return std::pair(static_cast<Index>(pairs[0].first), static_cast<Index>(pairs[0].second));
}

// As often as outer shells around it outnumber cavities: not by the number of shells alone, which may overlap.
bool TriangleSurface::inside(const Point<3>& p) const {
  if (tree_->shells.empty()) return (*tree_->side)(cgal(p)) == CGAL::ON_BOUNDED_SIDE;
  int times = 0;
  for (const auto& shell : tree_->shells) times += shell->holds(cgal(p)) ? shell->sign : 0;
  return times > 0;
}

std::optional<Point<3>> TriangleSurface::crossing(const Point<3>& a, const Point<3>& b) const {
  if (a == b) return {};
  const auto hit = tree_->aabb.any_intersection(Kernel::Segment_3(cgal(a), cgal(b)));
  if (!hit) return {};
  return plain(boost::get<Kernel::Point_3>(hit->first));
}

Index TriangleSurface::nearest_triangle(const Point<3>& p) const {
  return static_cast<Index>(tree_->aabb.closest_point_and_primitive(cgal(p)).second);
}

void TriangleSurface::approach(const Point<3>& p, const std::function<double(Index)>& visit) const {
  Approach approach(visit);
  tree_->aabb.traversal_with_priority(p, approach);
}

}  // namespace signorini::geometry
