#include "driver/scene/symmetry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/component/failure.hpp"
#include "core/fem/assembly/elastic_matrix.hpp"
#include "core/fem/assembly/resultant.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/fem/model/obstacle_motion.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

constexpr double same = 1e-6;  // difference of values that are one, relative to the largest

/// Between two bodies the other one's faces go on where the first one's do.
template <int D, int B>
void refuse_one_sided(const Mesh<D>& mesh, const ObstacleTerm<B>& term, Planes across, double t) {
  const Planes missing = across & ~planes_across(Nodes<D>(mesh), term.other, t);
  for (std::size_t m = 0; m < mesh.mirrors.size(); ++m)
    if (missing >> m & 1u)
      input_error(term.origin, fmt::format("faces of the first body are on both sides of the plane of symmetry {}, and "
                                           "those of the other one on one side; expected both on both sides",
                                           plane_name(mesh.mirrors[m])));
}

/// A place where values are compared with those at its image.
template <int D>
struct ComparedPlace {
  Point<D> x, normal;
};

template <int D>
std::vector<ComparedPlace<D>> places_on(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  std::vector<ComparedPlace<D>> out;
  for (const Index f : faces) {
    Point<D> normal = area_normal(mesh, mesh.boundary[f]);
    normalise(normal);
    for (const Index v : mesh.boundary[f].vertices) out.push_back({mesh.points[v], normal});
  }
  return out;
}

template <int D>
std::vector<ComparedPlace<D>> places_on(const Mesh<D>& mesh, const Selection& on, double t) {
  if (on.picks_faces()) return places_on(mesh, select_faces(mesh, on, t));
  std::vector<ComparedPlace<D>> out;
  const Nodes<D> nodes(mesh);
  for (const Index p : select_nodes(nodes, on, t)) out.push_back({nodes.at(p), {}});
  return out;
}

template <int D>
std::vector<ComparedPlace<D>> all_places(const Mesh<D>& mesh) {
  std::vector<ComparedPlace<D>> out;
  for (const Point<D>& x : mesh.points) out.push_back({x, {}});
  return out;
}

/// Compares numbers at places with those at their images.
template <int D>
class Comparison {
 public:
  Comparison(const Mirror& mirror, std::string origin) : mirror_(mirror), origin_(std::move(origin)) {}

  void add(const Point<D>& x, double here, double at_image) {
    for (const double value : {here, at_image})
      if (std::isfinite(value)) largest_ = std::max(largest_, std::abs(value));
    if (here == at_image) return;  // infinite ones, too
    const double off = std::abs(here - at_image);
    if (off <= most_) return;
    most_ = off;
    at_ = x;
    here_ = here;
    there_ = at_image;
  }
  /// What values are to be compared with beside themselves.
  void scale(double size) { largest_ = std::max(largest_, size); }

  void refuse(std::string_view what) const {
    if (!(most_ > same * largest_)) return;
    input_error(origin_,
                fmt::format("{} is not symmetric about {}: {:g} at ({}), and {:g} as the image of what is at ({}); "
                            "expected the same, or faces on one side alone",
                            what, plane_name(mirror_), here_, fmt::join(at_, ", "), there_,
                            fmt::join(reflected<D>(mirror_, at_), ", ")));
  }

 private:
  const Mirror& mirror_;
  std::string origin_;
  double largest_ = 0, most_ = 0, here_ = 0, there_ = 0;
  Point<D> at_{};
};

/// All comparisons about one plane.
template <int D, int B>
class SymmetryCheck {
 public:
  SymmetryCheck(const Mesh<D>& mesh, const Model<B>& model, std::size_t number)
      : mesh_(mesh), model_(model), mirror_(mesh.mirrors[number]), bit_(1u << number) {
    for (const Point<D>& x : mesh.points) extent_ = std::max(extent_, max_norm(x));
  }

  void run(const ConditionsAcross& across) const {
    check_material();
    for (std::size_t k = 0; k < model_.fixes.size(); ++k)
      if (across.fixes[k] & bit_) check_fix(model_.fixes[k]);
    for (std::size_t k = 0; k < model_.loads.size(); ++k)
      if (across.loads[k] & bit_) check_load(model_.loads[k]);
    for (std::size_t k = 0; k < model_.springs.size(); ++k)
      if (across.springs[k] & bit_) check_spring(model_.springs[k]);
    for (std::size_t k = 0; k < model_.obstacles.size(); ++k)
      if (across.obstacles[k] & bit_) check_obstacle(model_.obstacles[k]);
  }

 private:
  Site site_of(const ComparedPlace<D>& p) const { return site<D>(p.x, model_.t, p.normal); }
  ComparedPlace<D> image(const ComparedPlace<D>& p) const {
    return {reflected<D>(mirror_, p.x), reflected_direction<D>(mirror_, p.normal)};
  }
  /// Of a component along a coordinate axis.
  double sign(int component) const { return B > 1 && component == mirror_.axis ? -1 : 1; }

  void check_material() const {
    const auto compare = [&](const Field& field, const char* what) {
      if (field.constant()) return;
      Comparison<D> comparison(mirror_, field.origin());
      for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
        const Point<D> x = centroid<D>(mesh_, mesh_.elements[e]);
        comparison.add(x, field(site_in<D>(mesh_, e, x, model_.t)),
                       field(site_in<D>(mesh_, e, reflected<D>(mirror_, x), model_.t)));
      }
      comparison.refuse(what);
    };
    if (B == 1) return compare(model_.diffusion, "'diffusion'");
    compare(model_.young, "'young'");
    compare(model_.poisson, "'poisson'");
    check_orthotropic();
    compare(model_.expansion, "'expansion'");
    compare(model_.temperature, "'temperature'");
  }

  /// In the plane of the mirror its stiffness has no coupling between what is symmetric and what is not.
  void check_orthotropic() const {
    if constexpr (B == D) {
      const OrthotropicLaw<D> law(model_);
      if (law.none()) return;
      constexpr std::array<std::array<int, 2>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
      const auto sign_of = [&](std::size_t k) { return sign(axes[k][0]) * sign(axes[k][1]); };
      Comparison<D> comparison(mirror_, model_.origin);
      constexpr std::size_t n = strain_components<D>;
      for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
        const Point<D> x = centroid<D>(mesh_, mesh_.elements[e]);
        const Site here = site_in<D>(mesh_, e, x, model_.t);
        if (!law.acts_in(here.region)) continue;
        const ElasticMatrix<D> own = law.at(here),
                               other = law.at(site_in<D>(mesh_, e, reflected<D>(mirror_, x), model_.t));
        for (std::size_t k = 0; k < n * n; ++k) comparison.add(x, own[k], sign_of(k / n) * sign_of(k % n) * other[k]);
      }
      comparison.refuse("the orthotropic material");
    }
  }

  void check_fix(const Fix<B>& fix) const {
    Comparison<D> values(mirror_, fix.on.origin), frames(mirror_, fix.on.origin);
    frames.scale(1);
    for (const ComparedPlace<D>& p : places_on(mesh_, fix.on, model_.t)) {
      const ComparedPlace<D> q = image(p);
      const auto here = directions<D, B>(fix.frame, p.x, p.normal), there = directions<D, B>(fix.frame, q.x, q.normal);
      const bool on_axis = is_on_axis<D, B>(fix.frame, p.x);
      for (int i = 0; i < B; ++i) {
        if (!fix.value[i]) continue;
        double turn = 0;  // 1 or -1, where the frame is symmetric
        for (int j = 0; j < B; ++j) turn += sign(j) * there[i][j] * here[i][j];
        if (fix.frame.kind == Frame::cylindrical && !on_axis) frames.add(p.x, 1, std::abs(turn));
        values.add(p.x, (*fix.value[i])(site_of(p)), turn * (*fix.value[i])(site_of(q)));
      }
    }
    frames.refuse("the frame");
    values.refuse("'value'");
  }

  void check_load(const Load<B>& given) const {
    const Load<B> load = distributed(Nodes<D>(mesh_), model_, given);
    std::string origin = load.value[0].origin();  // of a constant there may be none
    if (origin.empty()) origin = load.on ? load.on->origin : model_.origin + ", its load";
    Comparison<D> comparison(mirror_, origin);
    for (const ComparedPlace<D>& p : load.on ? places_on(mesh_, *load.on, model_.t) : all_places(mesh_))
      for (int i = 0; i < B; ++i)
        comparison.add(p.x, load.value[i](site_of(p)), sign(i) * load.value[i](site_of(image(p))));
    comparison.refuse("the load");
  }

  void check_spring(const Spring<B>& spring) const {
    Comparison<D> comparison(mirror_, spring.on.origin);
    const auto matrix = [&](const ComparedPlace<D>& p) {
      return spring_matrix<D, B>(spring, 1, p.x, p.normal, model_.t);
    };
    for (const ComparedPlace<D>& p : places_on(mesh_, spring.on, model_.t)) {
      const auto here = matrix(p), there = matrix(image(p));
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) comparison.add(p.x, here[i * B + j], sign(i) * sign(j) * there[i * B + j]);
    }
    comparison.refuse("the stiffness of the spring");
  }

  void check_obstacle(const ObstacleTerm<B>& term) const {
    std::vector<ComparedPlace<D>> places;
    const Nodes<D> nodes(mesh_);
    const Surface<D> faces = term.on ? surface(nodes, select_faces(mesh_, *term.on, model_.t)) : surface(nodes);
    const std::vector<Point<D>> normals = node_normals(nodes, faces);
    if (!term.on) places = all_places(mesh_);
    for (std::size_t v = 0; v < faces.nodes.size(); ++v) {
      const ComparedPlace<D> p{mesh_.points[faces.nodes[v]], normals[v]};
      if (term.on)
        places.push_back(p);
      else
        places[faces.nodes[v]] = p;
    }
    std::vector<SurfaceVertex> here, there;
    for (const ComparedPlace<D>& p : places) {
      here.push_back(vertex(p));
      there.push_back(vertex(image(p)));
    }
    compare(term, places, here, there);
  }

  static SurfaceVertex vertex(const ComparedPlace<D>& p) {
    SurfaceVertex v{};
    v.measure = 1;
    std::copy_n(p.x.data(), D, v.position);
    std::copy_n(p.normal.data(), D, v.normal);
    return v;
  }

  void compare(const ObstacleTerm<B>& term, const std::vector<ComparedPlace<D>>& places,
               const std::vector<SurfaceVertex>& here, const std::vector<SurfaceVertex>& there) const {
    Comparison<D> bounds(mirror_, term.origin), directions(mirror_, term.origin), numbers(mirror_, term.origin),
        motion(mirror_, term.origin);
    if (B > 1) bounds.scale(extent_);
    directions.scale(1);
    std::vector<LocalConstraint<B>> at(here.size()), at_image(here.size());
    Status status;
    term.obstacle->assemble(here.data(), here.size(), at.data(), status);
    if (status.ok()) term.obstacle->assemble(there.data(), there.size(), at_image.data(), status);
    if (!status.ok()) throw_failure(status, term.origin);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Point<D>& x = places[k].x;
      numbers.add(x, at[k].directions, at_image[k].directions);
      for (int d = 0; d < std::min(at[k].directions, at_image[k].directions); ++d) {
        bounds.add(x, at[k].lower[d], at_image[k].lower[d]);
        bounds.add(x, at[k].upper[d], at_image[k].upper[d]);
        if (lies_on<D>(mirror_, x)) continue;  // as likely to be that on the other side
        for (int i = 0; i < B; ++i) directions.add(x, at[k].direction[d][i], sign(i) * at_image[k].direction[d][i]);
      }
      for (int d = 0; d < most_data; ++d) numbers.add(x, at[k].data[d], at_image[k].data[d]);
      const auto moved = obstacle_motion<B>(term, here[k], status),
                 moved_there = obstacle_motion<B>(term, there[k], status);
      if (!status.ok()) throw_failure(status, term.origin);
      for (int i = 0; i < B; ++i) motion.add(x, moved[i], sign(i) * moved_there[i]);
    }
    bounds.refuse("the bound of the obstacle");
    directions.refuse("the direction of the obstacle");
    numbers.refuse("an option of the obstacle");
    motion.refuse("the motion of the obstacle");
  }

  const Mesh<D>& mesh_;
  const Model<B>& model_;
  const Mirror& mirror_;
  Planes bit_;
  double extent_ = 0;
};

}  // namespace

template <int D, int B>
ConditionsAcross conditions_across(const Nodes<D>& nodes, const Model<B>& model) {
  const Mesh<D>& mesh = nodes.mesh();
  ConditionsAcross out;
  const auto add = [&](std::vector<Planes>& list, const std::optional<Selection>& on) {
    list.push_back(mesh.mirrors.empty() ? 0 : planes_across(nodes, on, model.t));
  };
  for (const Fix<B>& fix : model.fixes) add(out.fixes, fix.on);
  for (const Load<B>& load : model.loads) add(out.loads, load.on);
  for (const Spring<B>& spring : model.springs) add(out.springs, spring.on);
  for (const ObstacleTerm<B>& term : model.obstacles) {
    add(out.obstacles, term.on);
    if (term.other && !mesh.mirrors.empty()) refuse_one_sided(mesh, term, out.obstacles.back(), model.t);
  }
  return out;
}

template <int D, int B>
void refuse_asymmetric(const Mesh<D>& mesh, const Model<B>& model, const ConditionsAcross& across) {
  for (std::size_t m = 0; m < mesh.mirrors.size(); ++m) SymmetryCheck<D, B>(mesh, model, m).run(across);
}

template <int D, int B>
void check_symmetry(const MeshHierarchy<D>& hierarchy, const Model<B>& model) {
  constexpr Index enough = 20000;
  if (hierarchy.finest().mirrors.empty()) return;
  const Mesh<D>* mesh = &hierarchy.levels.front();
  for (const Mesh<D>& level : hierarchy.levels)
    if (level.vertices() <= enough) mesh = &level;
  refuse_asymmetric(*mesh, model, conditions_across(Nodes<D>(*mesh), model));
}

Whole::Whole(const std::vector<Mirror>& mirrors, Planes across) : copies_(1 << std::popcount(across)) {
  for (std::size_t m = 0; m < mirrors.size(); ++m)
    if (across >> m & 1u) axes_ |= 1u << mirrors[m].axis;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                          \
  template ConditionsAcross conditions_across(const Nodes<D>&, const Model<B>&);             \
  template void refuse_asymmetric(const Mesh<D>&, const Model<B>&, const ConditionsAcross&); \
  template void check_symmetry(const MeshHierarchy<D>&, const Model<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
