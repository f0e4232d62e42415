// Constrained Delaunay refinement in the plane (CGAL Mesh_2) with a position-dependent size.
#include "core/geometry/cgal/plane/planar.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_criteria_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/own_units.hpp"
#include "core/geometry/cgal/plane/outline.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

// Bound on the longest edge of a triangle relative to the size; makes the mean edge of a mesh the size within some per
// cent. Sides are divided by the size itself and so need no further division.
constexpr double edge_bound = 1.4;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

Point<2> plain(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

Point<2> centroid(const Triangulation::Face_handle& face) {
  const auto &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
  return {(a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3};
}

/// CGAL's criterion on angles, and one on edges by the size at the centroid. Large triangles come first.
class Criteria : public CGAL::Delaunay_mesh_criteria_2<Triangulation> {
  using Base = CGAL::Delaunay_mesh_criteria_2<Triangulation>;

 public:
  struct Quality {
    double sine = 0, edge = 0;  // squared sine of the least angle; squared longest edge over its bound
    bool operator<(const Quality& other) const {
      return edge > 1 || other.edge > 1 ? edge > other.edge : sine < other.sine;
    }
  };

  class Is_bad : public Base::Is_bad {
   public:
    Is_bad(const Criteria& criteria) : Base::Is_bad(criteria.bound(), criteria.traits), sizing_(*criteria.sizing_) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality& q) const {
      if (q.edge > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return q.sine < this->B ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    CGAL::Mesh_2::Face_badness operator()(const Triangulation::Face_handle& face, Quality& q) const {
      Base::Is_bad::operator()(face, q.sine);
      const double bound = edge_bound * sizing_(centroid(face));
      q.edge = 0;
      for (int k = 0; k < 3; ++k)
        q.edge = std::max(q.edge, CGAL::squared_distance(face->vertex(k)->point(), face->vertex((k + 1) % 3)->point()) /
                                      (bound * bound));
      return (*this)(q);
    }

   private:
    const Sizing<2>& sizing_;
  };

  explicit Criteria(const Sizing<2>* sizing) : sizing_(sizing) {}
  Is_bad is_bad_object() const { return Is_bad(*this); }

 private:
  const Sizing<2>* sizing_;
};

/// The vertices at which sides start, in the order of the sides.
std::vector<Triangulation::Vertex_handle> insert(Triangulation& triangulation, const Outline& outline,
                                                 const Sizing<2>& sizing) {
  std::vector<Triangulation::Vertex_handle> starts, all;
  for (const Side& side : outline.sides) {
    starts.push_back({});
    for (const Point<2>& p : divide(outline, side, sizing)) {
      const auto near = all.empty() ? Triangulation::Face_handle() : all.back()->face();
      all.push_back(triangulation.insert({p[0], p[1]}, near));
      if (starts.back() == Triangulation::Vertex_handle()) starts.back() = all.back();
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) triangulation.insert_constraint(all[i], all[(i + 1) % all.size()]);
  return starts;
}

// Elements that the size asks for, from its values at 16 points in each triangle of the unrefined triangulation.
double expected(const Triangulation& triangulation, const Sizing<2>& sizing) {
  constexpr int n = 4;
  double sum = 0;
  for (const auto face : triangulation.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const Point<2> a = plain(face->vertex(0)->point()), b = plain(face->vertex(1)->point()),
                   c = plain(face->vertex(2)->point());
    std::vector<double> sizes;
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const double s = (i + 1.0 / 3) / n, t = (j + 1.0 / 3) / n;
        sizes.push_back(
            sizing({a[0] + s * (b[0] - a[0]) + t * (c[0] - a[0]), a[1] + s * (b[1] - a[1]) + t * (c[1] - a[1])}));
      }
    sum += expected_elements<2>(triangulation.triangle(face).area(), sizes);
  }
  return sum;
}

Mesh<2> extract(const Triangulation& triangulation) {
  Mesh<2> mesh;
  for (const auto vertex : triangulation.finite_vertex_handles()) vertex->info() = -1;
  for (const auto face : triangulation.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    auto& element = mesh.elements.emplace_back();
    for (int k = 0; k < 3; ++k) {
      Index& number = face->vertex(k)->info();
      if (number < 0) {
        number = mesh.vertices();
        mesh.points.push_back(plain(face->vertex(k)->point()));
      }
      element[static_cast<std::size_t>(k)] = number;
    }
  }
  mesh.boundary = find_boundary<2>(mesh.vertices(), mesh.elements);
  return mesh;
}

/// The point of a straight side that is nearest to one beside it by rounding.
Point<2> onto(const Side& side, const Point<2>& p) {
  const Point<2> along = difference<2>(side.to, side.from);
  const std::size_t k = std::abs(along[0]) > std::abs(along[1]) ? 0 : 1;
  const double t = (p[k] - side.from[k]) / along[k];
  return {std::lerp(side.from[0], side.to[0], t), std::lerp(side.from[1], side.to[1], t)};
}

/// Walks once around the boundary, which passes the starts of the sides in their order: every face on the way belongs
/// to the side last started. Vertices are moved exactly onto the sides.
void name_sides(Mesh<2>& mesh, const Outline& outline, const std::vector<Index>& starts) {
  std::vector<Index> face_from(mesh.points.size(), -1);
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
    face_from[mesh.boundary[f].vertices[0]] = static_cast<Index>(f);
  if (outline.circle) mesh.curves = {*outline.circle};
  Index vertex = starts[0];
  for (std::size_t s = 0; s < outline.sides.size(); ++s) {
    const Side& side = outline.sides[s];
    Part part{side.part, {}};
    do {
      part.faces.push_back(face_from[vertex]);
      Face<2>& face = mesh.boundary[face_from[vertex]];
      if (side.curved) face.curve = 0;
      Point<2>& p = mesh.points[vertex];
      p = vertex == starts[s] ? side.from : side.curved ? project<2>(*outline.circle, p) : onto(side, p);
      vertex = face.vertices[1];
    } while (vertex != starts[(s + 1) % starts.size()]);
    std::sort(part.faces.begin(), part.faces.end());
    if (!part.name.empty()) mesh.parts.push_back(std::move(part));
  }
}

// Divides sides without looking at the size, for ever in places too narrow for its arithmetic. Hence an evaluation per
// vertex: it counts, and ends what the user interrupts.
void refine(Triangulation& triangulation, Sizing<2>& sizing) {
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(&sizing));
  mesher.init();
  sizing.expect(expected(triangulation, sizing));
  const Point<2> anywhere = plain(triangulation.finite_vertices_begin()->point());
  try {
    while (mesher.try_one_step_refine_mesh()) sizing(anywhere);
  } catch (const CGAL::Failure_exception&) {
    sizing.no_end();
  }
}

OwnUnits<2> units_of(const Disk& disk) { return {disk.center, disk.radius}; }
OwnUnits<2> units_of(const Polygon& polygon) { return own_units<2>(polygon.points); }

Disk in_own_units(const Disk& disk, const OwnUnits<2>&) {
  return {{0, 0}, 1, disk.lower_half, disk.right_half, disk.upper_half};
}
Polygon in_own_units(Polygon polygon, const OwnUnits<2>& units) {
  for (Point<2>& p : polygon.points) p = units.own(p, shape_digits);
  return polygon;
}

}  // namespace

Mesh<2> triangulate(const Shape2& shape, const Size<2>& size) {
  const Outline given = outline(shape);  // what is wrong is told in the user's units
  const OwnUnits<2> units = std::visit([](const auto& s) { return units_of(s); }, shape);
  const Outline own = outline(std::visit([&](const auto& s) { return Shape2(in_own_units(s, units)); }, shape));
  Sizing<2> sizing(size, own.coarsest_size, own.diameter, units, own.shape, given.narrowest);
  Triangulation triangulation;
  const auto starts = insert(triangulation, own, sizing);
  refine(triangulation, sizing);
  Mesh<2> mesh = extract(triangulation);
  for (Point<2>& p : mesh.points) p = units.given(p);
  std::vector<Index> numbers;
  for (const auto vertex : starts) numbers.push_back(vertex->info());
  name_sides(mesh, given, numbers);
  require_valid(own.shape, mesh);
  return mesh;
}

}  // namespace signorini::geometry
