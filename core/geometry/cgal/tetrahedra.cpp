// Delaunay refinement with protected creases, then exudation of slivers (CGAL Mesh_3). The one
// translation unit that instantiates these templates: all solids come through the abstract Domain.
#include "core/geometry/cgal/tetrahedra.hpp"

#include <CGAL/Mesh_3/Slivers_exuder.h>
#include <CGAL/Mesh_3/sliver_criteria.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/crease_spacing.hpp"
#include "core/geometry/cgal/filled.hpp"
#include "core/geometry/cgal/labels.hpp"
#include "core/geometry/cgal/mesh_domain.hpp"
#include "core/geometry/cgal/peel.hpp"
#include "core/geometry/cgal/reconnect.hpp"
#include "core/geometry/cgal/sizing.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

// Bounds, relative to the size, on edges along creases and on the circumradii of faces and of tetrahedra. They make the
// mean edge of a mesh the size within some per cent, measured on balls and cylinders of 400 to 300000 tetrahedra.
constexpr double edge_bound = 0.7, facet_bound = 0.65, cell_bound = 0.74;
// Dihedral angle in degrees below which slivers are exuded; what remains is 9 degrees or better on round shapes.
// CGAL's perturbation would add four degrees, but its result differs from run to run (5.5).
constexpr double least_dihedral_angle = 15;

/// A multiple of the size field, as CGAL's concept MeshDomainField_3.
struct ScaledSize {
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = MeshDomain::Index;
  const Sizing<3>* sizing;
  double factor;
  FT operator()(const Point_3& p, int, const Index&) const { return factor * (*sizing)(plain(p)); }
};

/// CGAL's criterion for exudation, which also ends what the user interrupts.
class Slivers : public CGAL::Mesh_3::Min_dihedral_angle_criterion<Triangulation> {
  using Base = CGAL::Mesh_3::Min_dihedral_angle_criterion<Triangulation>;

 public:
  Slivers(const Triangulation& triangulation, const Sizing<3>* sizing)
      : Base(least_dihedral_angle, triangulation), sizing_(sizing) {}
  using Base::operator();
  double operator()(const Kernel::Tetrahedron_3& tetrahedron) const override {
    if (++calls_ % 1024 == 0) sizing_->poll();
    return Base::operator()(tetrahedron);
  }

 private:
  const Sizing<3>* sizing_;
  mutable std::size_t calls_ = 0;
};

/// Ends exudation between two steps: when the user interrupts, or when there have been more steps than cells, of which
/// it mends a few.
class ExudingWatch {
 public:
  struct Enough {};

  ExudingWatch(const Sizing<3>* sizing, std::size_t most) : sizing_(sizing), left_(most) {}
  void after_cell_pumped(std::size_t) {
    if (left_-- == 0) throw Enough();
    sizing_->poll();
  }

 private:
  const Sizing<3>* sizing_;
  std::size_t left_;
};

// Not by make_mesh_3, which limits its time by that of the refinement: meshes would differ from run to run.
void exude(Complex& complex, const Sizing<3>& sizing) {
  using Exuder = CGAL::Mesh_3::Slivers_exuder<Complex, Slivers, ExudingWatch>;
  try {
    Exuder(complex, Slivers(complex.triangulation(), &sizing))(
        ExudingWatch(&sizing, 1000 + complex.number_of_cells_in_complex()));
  } catch (const ExudingWatch::Enough&) {  // the mesh is as good as it gets
  }
}

/// How the inside is told.
enum class Way {
  manifold,  ///< by the centres of cells' spheres, refined until the surface is a manifold. Near sharp angles between
             ///< faces it may be refined for ever without a further vertex: those asked for are too close to edges
  middles,   ///< see LabelsByMiddles
};

Complex refine(const Domain& domain, const Sizing<3>& sizing, Way way) {
  CGAL::get_default_random() = CGAL::Random(0);
  RefinementWatch watch(&sizing);
  MeshDomain mesh_domain(&domain, &sizing, &watch);
  std::vector<std::vector<Kernel::Point_3>> creases;
  for (const Polyline& crease : domain.creases()) {
    creases.emplace_back();
    std::transform(crease.begin(), crease.end(), std::back_inserter(creases.back()), cgal);
  }
  mesh_domain.add_features(creases.begin(), creases.end());
  for (const Point<3>& tip : domain.tips()) mesh_domain.add_corner(cgal(tip));

  namespace p = CGAL::parameters;
  const Criteria criteria(p::edge_size = ScaledSize{&sizing, edge_bound}, p::facet_angle = 25,
                          p::facet_size = ScaledSize{&sizing, facet_bound},
                          p::facet_distance = ScaledSize{&sizing, domain.flatness()}, p::cell_radius_edge_ratio = 2,
                          p::cell_size = ScaledSize{&sizing, cell_bound});
  CGAL::Mesh_error_code error = CGAL::CGAL_MESH_3_NO_ERROR;
  Complex complex;
  watch.expect_vertices([&] { return complex.triangulation().number_of_vertices(); });
  CGAL::make_mesh_3_impl(
      complex, mesh_domain, criteria, p::no_exude(), p::no_perturb(), p::no_odt(), p::no_lloyd(), true,
      p::mesh_3_options(p::maximal_number_of_vertices = sizing.most_vertices(), p::pointer_to_error_code = &error),
      way == Way::manifold ? p::manifold() : p::non_manifold());
  if (error != CGAL::CGAL_MESH_3_NO_ERROR) sizing.no_end();
  if (way == Way::middles) LabelsByMiddles(complex, domain, sizing).put();
  exude(complex, sizing);
  return complex;
}

struct Extract {
  Mesh<3> mesh;  ///< in the domain's own coordinates, without parts
  std::vector<bool> on_crease;
  std::vector<CreaseEdge> creases;
};

Extract extract(const Complex& complex) {
  Extract out;
  std::unordered_map<Triangulation::Vertex_handle, Index, CGAL::Handle_hash_function> numbers;
  const auto position = [&](Triangulation::Vertex_handle vertex) {
    return plain(complex.triangulation().geom_traits().construct_point_3_object()(vertex->point()));
  };
  const auto number = [&](Triangulation::Vertex_handle vertex) {
    const auto [entry, fresh] = numbers.emplace(vertex, out.mesh.vertices());
    if (fresh) {
      out.mesh.points.push_back(position(vertex));
      out.on_crease.push_back(complex.in_dimension(vertex) <= 1);
    }
    return entry->second;
  };
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    auto& element = out.mesh.elements.emplace_back();
    for (int k = 0; k < 4; ++k) element[static_cast<std::size_t>(k)] = number(cell->vertex(k));
  }
  for (auto edge = complex.edges_in_complex_begin(); edge != complex.edges_in_complex_end(); ++edge) {
    const auto a = edge->first->vertex(edge->second), b = edge->first->vertex(edge->third);
    const auto known = [&](Triangulation::Vertex_handle v) { return numbers.contains(v) ? numbers[v] : -1; };
    const Point<3> p = position(a), q = position(b);
    out.creases.push_back({{known(a), known(b)},
                           {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2},
                           length<3>(difference<3>(p, q))});
  }
  return out;
}

// Size values at the points inside the domain of a regular grid over its box, and on its surface.
std::vector<double> sampled_sizes(const Domain& domain, const Sizing<3>& sizing) {
  constexpr int n = 20;
  std::vector<double> sizes;
  const auto [low, high] = domain.box();
  for (int i = 0; i < n * n * n; ++i) {
    const int cell[3] = {i % n, i / n % n, i / n / n};
    Point<3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = low[k] + (cell[k] + 0.5) / n * (high[k] - low[k]);
    if (domain.inside(p)) sizes.push_back(sizing(p));
  }
  for (const Point<3>& p : domain.surface_points()) sizes.push_back(sizing(p));
  if (sizes.empty()) sizes.push_back(sizing(low));
  return sizes;
}

Extract mesh_of(const Domain& domain, const Sizing<3>& sizing, Way way) {
  Extract out = extract(refine(domain, sizing, way));
  Mesh<3>& mesh = out.mesh;
  if (mesh.elements.empty()) throw ShapeError(domain.name(), "size", "too large to resolve the shape");
  replace_flat_elements(mesh);
  mesh.boundary = find_boundary<3>(mesh.vertices(), mesh.elements);
  peel_slivers(mesh, out.creases);
  return out;
}

/// Halves sizes where something is missed, in some places of those that are near each other.
bool halve(Sizing<3>& sizing, const Missed& missed) {
  constexpr std::size_t most_places = 50;
  constexpr double reach = 2;  // of elements there
  std::vector<Missed::Place> taken;
  for (const Missed::Place& place : missed.places) {
    if (taken.size() == most_places) break;
    if (std::ranges::any_of(taken, [&](const Missed::Place& other) {
          return length<3>(difference<3>(other.at, place.at)) < other.size;
        }))
      continue;
    taken.push_back(place);
    sizing.halve_near(place.at, reach * place.size);
  }
  return !taken.empty();
}

/// A mesh that fills the domain, made in the way that is exact for it if that will do. Where neither does, sizes are
/// halved at places that are missed, until the work has been that of many meshes.
Extract filling(const Domain& domain, Sizing<3>& sizing, double elements) {
  if (!domain.may_be_missed()) return mesh_of(domain, sizing, Way::manifold);
  constexpr double spare_elements = 1e5, most_times = 10;
  double left = spare_elements + most_times * elements;
  std::string complaint;
  Missed missed;
  const auto attempt = [&](Way way) -> std::optional<Extract> {
    missed = {};
    sizing.expect(elements);
    try {
      Extract out = mesh_of(domain, sizing, way);
      missed = find_missed(out.mesh, domain, out.creases);
      left -= static_cast<double>(out.mesh.elements.size());
      if (!missed) return out;
      complaint = missed.complaint;
    } catch (const NoEnd& error) {
      complaint = error.complaint();
    }
    return {};
  };
  const bool flat = domain.flat();
  for (const Way way : {flat ? Way::middles : Way::manifold, flat ? Way::manifold : Way::middles})
    if (auto out = attempt(way)) return std::move(*out);
  while (left > 0 && halve(sizing, missed))
    if (auto out = attempt(Way::middles)) return std::move(*out);
  throw ShapeError(domain.name(), "size", complaint);
}

}  // namespace

Mesh<3> tetrahedralize(const Domain& domain, const Size<3>& size) {
  const auto [low, high] = domain.box();
  Sizing<3> sizing(size, domain.coarsest_size(), std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]),
                   domain.units(), domain.name());
  const auto sizes = sampled_sizes(domain, sizing);
  sizing.check_thickness(domain.volume());
  const double elements = expected_elements<3>(domain.volume(), sizes);
  sizing.expect(elements);
  check_crease_spacing(domain, sizing);
  Extract out = filling(domain, sizing, elements);
  domain.finish(out.mesh, out.on_crease);
  require_valid(domain.name(), out.mesh);
  return std::move(out.mesh);
}

}  // namespace signorini::geometry
