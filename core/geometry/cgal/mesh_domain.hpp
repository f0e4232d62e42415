// CGAL's view of a Domain. For the one translation unit that instantiates its mesher.
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>

#include <functional>
#include <optional>

#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/cgal/sizing.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Point<3> plain(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }
inline Kernel::Point_3 cgal(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// Ends a refinement that asks on and on without making a vertex: near sharp angles between faces those that would make
/// the surface a manifold are too close to edges.
class RefinementWatch {
 public:
  explicit RefinementWatch(const Sizing<3>* sizing) : sizing_(sizing) {}
  /// From now on vertices are to be made; `count` says how many there are.
  void expect_vertices(std::function<std::size_t()> count) { count_ = std::move(count); }
  /// Counts a question that is asked about a place.
  void query(const Point<3>& place) const {
    sizing_->count_query();
    if (!count_) return;
    if (const std::size_t vertices = count_(); vertices != vertices_) {
      vertices_ = vertices;
      since_ = 0;
    } else if (++since_ > few_queries + queries_per_vertex * vertices) {
      sizing_->no_end(place);
    }
  }

 private:
  // Scans of all cells take ten to forty for each vertex.
  static constexpr std::size_t few_queries = 10000, queries_per_vertex = 100;

  const Sizing<3>* sizing_;
  std::function<std::size_t()> count_;
  mutable std::size_t vertices_ = 0, since_ = 0;
};

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

  /// `watch` counts the queries, and ends the work when they get too many or the user interrupts.
  Oracle(const Domain* domain, const RefinementWatch* watch) : domain_(domain), watch_(watch) {}

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
      oracle.watch_->query(plain(p));
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
    watch_->query(plain(query.point(0)));
    const auto segment = domain_->exact() ? ends(query) : clipped(query);
    return segment ? domain_->crossing(segment->first, segment->second) : std::nullopt;
  }

  const Domain* domain_;
  const RefinementWatch* watch_;
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
  MeshDomain(const Domain* domain, const Sizing<3>* sizing, const RefinementWatch* watch)
      : Base(domain, watch), sizing_(sizing) {}

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

}  // namespace signorini::geometry
