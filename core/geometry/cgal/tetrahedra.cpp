// Delaunay refinement with protected creases, then exudation of slivers (CGAL Mesh_3). The one
// translation unit that instantiates these templates: all solids come through the abstract Domain.
#include "core/geometry/cgal/tetrahedra.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Mesh_3/Slivers_exuder.h>
#include <CGAL/Mesh_3/sliver_criteria.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/crease_spacing.hpp"
#include "core/geometry/cgal/peel.hpp"
#include "core/geometry/cgal/reconnect.hpp"
#include "core/geometry/cgal/sizing.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/hinges.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

// Bounds, relative to the size, on edges along creases and on the circumradii of faces and of tetrahedra. They make the
// mean edge of a mesh the size within some per cent, measured on balls and cylinders of 400 to 300000 tetrahedra.
constexpr double edge_bound = 0.7, facet_bound = 0.65, cell_bound = 0.74;
// Dihedral angle in degrees below which slivers are exuded; what remains is 9 degrees or better on round shapes.
// CGAL's perturbation would add four degrees, but its result differs from run to run (5.5).
constexpr double least_dihedral_angle = 15;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Point<3> plain(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }
Kernel::Point_3 cgal(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// A Domain as a model of CGAL's concept MeshDomain_3, with one subdomain and one surface patch.
class Oracle {
 public:
  using R = Kernel;
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Segment_3 = Kernel::Segment_3;
  using Ray_3 = Kernel::Ray_3;
  using Line_3 = Kernel::Line_3;
  using Vector_3 = Kernel::Vector_3;
  using Has_features = CGAL::Tag_false;
  using Subdomain_index = int;
  using Subdomain = boost::optional<Subdomain_index>;
  using Surface_patch_index = std::pair<int, int>;
  using Surface_patch = boost::optional<Surface_patch_index>;
  using Index = boost::variant<Subdomain_index, Surface_patch_index>;
  using Intersection = std::tuple<Point_3, Index, int>;

  /// `sizing` counts the queries, and ends the work when they get too many or the user interrupts.
  Oracle(const Domain* domain, const Sizing<3>* sizing) : domain_(domain), sizing_(sizing) {}

  CGAL::Bbox_3 bbox() const {
    const auto [a, b] = domain_->box();
    return {a[0], a[1], a[2], b[0], b[1], b[2]};
  }

  struct Construct_initial_points {
    const Oracle& oracle;
    template <class Output>
    Output operator()(Output out, int = 0) const {
      for (const Point<3>& p : oracle.domain_->surface_points()) *out++ = std::pair(cgal(p), Index(surface_patch()));
      return out;
    }
  };
  struct Is_in_domain {
    const Oracle& oracle;
    Subdomain operator()(const Point_3& p) const {
      oracle.sizing_->count_query();
      return oracle.domain_->inside(plain(p)) ? Subdomain(1) : Subdomain();
    }
  };
  struct Construct_intersection {
    const Oracle& oracle;
    template <class Query>
    Intersection operator()(const Query& query) const {
      const auto p = oracle.crossing(query);
      return p ? Intersection(cgal(*p), Index(surface_patch()), 2) : Intersection(Point_3(), Index(), 0);
    }
  };
  struct Do_intersect_surface {
    const Oracle& oracle;
    template <class Query>
    Surface_patch operator()(const Query& query) const {
      return oracle.crossing(query) ? Surface_patch(surface_patch()) : Surface_patch();
    }
  };

  Construct_initial_points construct_initial_points_object() const { return {*this}; }
  Is_in_domain is_in_domain_object() const { return {*this}; }
  Construct_intersection construct_intersection_object() const { return {*this}; }
  Do_intersect_surface do_intersect_surface_object() const { return {*this}; }

  Index index_from_surface_patch_index(const Surface_patch_index& index) const { return index; }
  Index index_from_subdomain_index(const Subdomain_index& index) const { return index; }
  Surface_patch_index surface_patch_index(const Index& index) const { return boost::get<Surface_patch_index>(index); }
  Subdomain_index subdomain_index(const Index& index) const { return boost::get<Subdomain_index>(index); }

 private:
  static Surface_patch_index surface_patch() { return {0, 1}; }

  using Ends = std::pair<Point<3>, Point<3>>;

  // The part of a segment, ray or line within a box somewhat larger than the domain's: dual edges may reach millions of
  // diameters out, where closed forms for crossings have no correct digit left.
  template <class Query>
  std::optional<Ends> clipped(const Query& query) const {
    const Point_3 p = query.point(0);
    const Vector_3 v = query.to_vector();
    const auto [low, high] = domain_->box();
    double first = std::is_same_v<Query, Line_3> ? -infinity : 0;
    double last = std::is_same_v<Query, Segment_3> ? 1 : infinity;
    for (int k = 0; k < 3; ++k) {
      const double margin = high[k] - low[k];
      if (v[k] != 0) {
        const double one = (low[k] - margin - p[k]) / v[k], two = (high[k] + margin - p[k]) / v[k];
        first = std::max(first, std::min(one, two));
        last = std::min(last, std::max(one, two));
      } else if (p[k] < low[k] - margin || p[k] > high[k] + margin) {
        return {};
      }
    }
    if (!(first < last) || !std::isfinite(first) || !std::isfinite(last)) return {};
    return Ends(plain(p + first * v), last == 1 ? plain(p + v) : plain(p + last * v));
  }

  // The ends of a segment as they are: inside() is asked for them too, and the answers have to agree. Of a ray or a
  // line the part that reaches beyond the domain.
  template <class Query>
  std::optional<Ends> ends(const Query& query) const {
    if constexpr (std::is_same_v<Query, Segment_3>) {
      return Ends(plain(query.source()), plain(query.target()));
    } else {
      const auto [low, high] = domain_->box();
      const Point_3 p = query.point(0);
      const Vector_3 v = query.to_vector();
      const double reach = std::sqrt(CGAL::squared_distance(p, cgal(low))) + length<3>(difference<3>(high, low));
      const Vector_3 beyond = 2 * reach / std::sqrt(v * v) * v;
      return Ends(plain(std::is_same_v<Query, Ray_3> ? p : p - beyond), plain(p + beyond));
    }
  }

  template <class Query>
  std::optional<Point<3>> crossing(const Query& query) const {
    sizing_->count_query();
    const auto segment = domain_->exact() ? ends(query) : clipped(query);
    return segment ? domain_->crossing(segment->first, segment->second) : std::nullopt;
  }

  const Domain* domain_;
  const Sizing<3>* sizing_;
};

/// The distances that exudation takes its weights from, exact where the differences of floating point numbers have no
/// correct digits left: four vertices on a flat face are coplanar but for rounding. Wrong weights make exudation pump
/// the same vertex for ever, and those that are not finite end the program.
struct ExudingKernel : Kernel {
  struct Compute_power_distance_to_power_sphere_3 {
    using result_type = FT;
    using P = Weighted_point_3;
    FT operator()(const P& p, const P& q, const P& r, const P& s, const P& t) const {
      if (precise(p, q, r, s, t)) return Kernel().compute_power_distance_to_power_sphere_3_object()(p, q, r, s, t);
      return CGAL::to_double(in<CGAL::Simple_cartesian<CGAL::Exact_rational>>(p, q, r, s, t));
    }

   private:
    template <class K>
    static typename K::FT in(const P& p, const P& q, const P& r, const P& s, const P& t) {
      const CGAL::Cartesian_converter<Kernel, K> c;
      return K().compute_power_distance_to_power_sphere_3_object()(c(p), c(q), c(r), c(s), c(t));
    }
    static bool precise(const P& p, const P& q, const P& r, const P& s, const P& t) {
      const CGAL::Protect_FPU_rounding<true> protect;
      return CGAL::has_smaller_relative_precision(in<CGAL::Simple_cartesian<CGAL::Interval_nt_advanced>>(p, q, r, s, t),
                                                  1e-6);
    }
  };
  Compute_power_distance_to_power_sphere_3 compute_power_distance_to_power_sphere_3_object() const { return {}; }
};

/// The Oracle with creases. What CGAL asks for as it protects them counts as queries, and the points that it makes as
/// vertices: it does not look at their number there.
class MeshDomain : public CGAL::Mesh_domain_with_polyline_features_3<Oracle> {
  using Base = CGAL::Mesh_domain_with_polyline_features_3<Oracle>;

 public:
  MeshDomain(const Domain* domain, const Sizing<3>* sizing) : Base(domain, sizing), sizing_(sizing) {}

  Point_3 construct_point_on_curve(const Point_3& start, const Curve_index& curve, FT distance) const {
    sizing_->count_query();
    if (++points_ > sizing_->most_vertices()) sizing_->no_end();
    return Base::construct_point_on_curve(start, curve, distance);
  }
  FT curve_segment_length(const Point_3& p, const Point_3& q, const Curve_index& curve, CGAL::Orientation o) const {
    sizing_->count_query();
    return Base::curve_segment_length(p, q, curve, o);
  }
  CGAL::Sign distance_sign(const Point_3& p, const Point_3& q, const Curve_index& curve) const {
    sizing_->count_query();
    return Base::distance_sign(p, q, curve);
  }

 private:
  const Sizing<3>* sizing_;
  mutable std::size_t points_ = 0;
};

using Triangulation = CGAL::Mesh_triangulation_3<MeshDomain, ExudingKernel, CGAL::Sequential_tag>::type;
using Complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, MeshDomain::Corner_index, MeshDomain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

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

/// Whether the refinement goes on until the surface is a manifold. Near sharp angles between faces it may do so for
/// ever without a further vertex: those that it asks for are too close to edges.
enum class Surface { manifold, any };

/// @param factor of the sizes
Complex refine(const Domain& domain, const Sizing<3>& sizing, Surface surface, double factor) {
  CGAL::get_default_random() = CGAL::Random(0);
  MeshDomain mesh_domain(&domain, &sizing);
  std::vector<std::vector<Kernel::Point_3>> creases;
  for (const Polyline& crease : domain.creases()) {
    creases.emplace_back();
    std::transform(crease.begin(), crease.end(), std::back_inserter(creases.back()), cgal);
  }
  mesh_domain.add_features(creases.begin(), creases.end());

  namespace p = CGAL::parameters;
  const Criteria criteria(p::edge_size = ScaledSize{&sizing, factor * edge_bound}, p::facet_angle = 25,
                          p::facet_size = ScaledSize{&sizing, factor * facet_bound},
                          p::facet_distance = ScaledSize{&sizing, factor * domain.flatness()},
                          p::cell_radius_edge_ratio = 2, p::cell_size = ScaledSize{&sizing, factor * cell_bound});
  CGAL::Mesh_error_code error = CGAL::CGAL_MESH_3_NO_ERROR;
  auto complex = CGAL::make_mesh_3<Complex>(
      mesh_domain, criteria, surface == Surface::manifold ? p::manifold() : p::non_manifold(), p::no_perturb(),
      p::no_exude(),
      p::mesh_3_options(p::maximal_number_of_vertices = sizing.most_vertices(), p::pointer_to_error_code = &error));
  if (error != CGAL::CGAL_MESH_3_NO_ERROR) sizing.no_end();
  return complex;
}

Mesh<3> extract(const Complex& complex, std::vector<bool>& on_crease) {
  Mesh<3> mesh;
  std::unordered_map<Triangulation::Vertex_handle, Index, CGAL::Handle_hash_function> numbers;
  const Triangulation& triangulation = complex.triangulation();
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    auto& element = mesh.elements.emplace_back();
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [entry, fresh] = numbers.emplace(vertex, mesh.vertices());
      element[static_cast<std::size_t>(k)] = entry->second;
      if (!fresh) continue;
      mesh.points.push_back(plain(triangulation.geom_traits().construct_point_3_object()(vertex->point())));
      on_crease.push_back(complex.in_dimension(vertex) <= 1);
    }
  }
  return mesh;
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

/// In the domain's own coordinates, without parts.
Mesh<3> mesh_of(const Domain& domain, const Sizing<3>& sizing, Surface surface, double factor,
                std::vector<bool>& on_crease) {
  on_crease.clear();
  Complex complex = refine(domain, sizing, surface, factor);
  exude(complex, sizing);
  Mesh<3> mesh = extract(complex, on_crease);
  if (mesh.elements.empty()) throw ShapeError(domain.name(), "size", "too large to resolve the shape");
  replace_flat_elements(mesh);
  mesh.boundary = find_boundary<3>(mesh.vertices(), mesh.elements);
  peel_slivers(mesh);
  return mesh;
}

bool is_manifold(const Mesh<3>& mesh) {
  const Hinges hinges = find_hinges(mesh);
  return hinges.vertices.empty() && hinges.edges.empty();
}

/// Where a manifold is not come to soon, one is hoped for without asking for it, then at sizes somewhat smaller: near
/// sharp angles it depends on where the first vertices happen to be. (Not at once: the meshes of all other shapes are
/// as they are.)
Mesh<3> patient_mesh(const Domain& domain, Sizing<3>& sizing, double elements, std::vector<bool>& on_crease) {
  sizing.be_impatient(elements);
  try {
    return mesh_of(domain, sizing, Surface::manifold, 1, on_crease);
  } catch (const NoEnd&) {
  }
  for (const double factor : {1.0, 0.9, 0.8, 0.7, 0.6}) {
    sizing.expect(elements / (factor * factor * factor));
    Mesh<3> mesh = mesh_of(domain, sizing, Surface::any, factor, on_crease);
    if (is_manifold(mesh)) return mesh;
  }
  sizing.expect(elements);
  return mesh_of(domain, sizing, Surface::manifold, 1, on_crease);
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
  std::vector<bool> on_crease;
  Mesh<3> mesh = patient_mesh(domain, sizing, elements, on_crease);
  domain.finish(mesh, on_crease);
  require_valid(domain.name(), mesh);
  return mesh;
}

}  // namespace signorini::geometry
