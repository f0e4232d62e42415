#include "estimators/certificate/true_problem.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "core/fem/assembly/resultant.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {
namespace {

template <int B>
bool is_constant(const Load<B>& load) {
  return std::ranges::all_of(load.value, [](const Field& f) { return f.constant().has_value(); });
}

template <int B>
std::array<double, B> value(const Load<B>& load, const Site& where) {
  std::array<double, B> f;
  for (int i = 0; i < B; ++i) f[i] = load.value[i](where);
  return f;
}

template <std::size_t B>
void add(double factor, const std::array<double, B>& from, std::array<double, B>& to) {
  for (std::size_t i = 0; i < B; ++i) to[i] += factor * from[i];
}

/// A field on a simplex of dimension K: its mean and moments by a rule of degree 5, and whether it is linear there.
template <int D, int K, int B>
struct OnSimplex {
  std::array<double, B> mean{};
  std::array<std::array<double, B>, K + 1> moment{};           // integrals times hat functions, over the measure
  std::array<std::array<double, B>, K*(K + 1) / 2> of_edge{};  // times bubbles
  // Mean square distance from the mean, of faces from linear; the largest distance from linear, and the largest value.
  double square = 0, off = 0, largest = 0;

  OnSimplex(const Load<B>& load, const std::array<Point<D>, K + 1>& corner, const Site& at) {
    if (is_constant(load))
      take_constant(value(load, at));
    else
      take_field(load, corner, at);
  }

 private:
  void take_field(const Load<B>& load, const std::array<Point<D>, K + 1>& corner, const Site& at) {
    std::array<std::array<double, B>, K + 1> of_corner;
    const auto value_at = [&](const std::array<double, K + 1>& barycentric) {
      Site site = at;
      std::fill_n(site.x, D, 0.0);
      for (int a = 0; a <= K; ++a)
        for (int i = 0; i < D; ++i) site.x[i] += barycentric[a] * corner[a][i];
      return value(load, site);
    };
    for (int a = 0; a <= K; ++a) {
      std::array<double, K + 1> barycentric{};
      barycentric[a] = 1;
      of_corner[a] = value_at(barycentric);
    }
    for (const auto& [barycentric, weight] : quadrature5<K>()) {
      const auto f = value_at(barycentric);
      add_point(f, barycentric, weight);
      for (int i = 0; i < B; ++i) {
        double linear = 0;
        for (int a = 0; a <= K; ++a) linear += barycentric[a] * of_corner[a][i];
        off = std::max(off, std::fabs(f[i] - linear));
        if (K < D) square += weight * (f[i] - linear) * (f[i] - linear);
        largest = std::max(largest, std::fabs(f[i]));
      }
    }
    if (K < D) return;
    for (const auto& [barycentric, weight] : quadrature5<K>()) {
      const auto f = value_at(barycentric);
      for (int i = 0; i < B; ++i) square += weight * (f[i] - mean[i]) * (f[i] - mean[i]);
    }
  }

  void take_constant(const std::array<double, B>& f) {
    mean = f;
    for (auto& m : moment) add(1.0 / (K + 1), f, m);
    for (auto& m : of_edge) add(4.0 / ((K + 1) * (K + 2)), f, m);
  }
  void add_point(const std::array<double, B>& f, const std::array<double, K + 1>& at, double weight) {
    constexpr auto edges = simplex_edges<K>();
    add(weight, f, mean);
    for (int a = 0; a <= K; ++a) add(weight * at[a], f, moment[a]);
    for (std::size_t k = 0; k < edges.size(); ++k) add(weight * 4 * at[edges[k][0]] * at[edges[k][1]], f, of_edge[k]);
  }
};

template <int D, int B>
class Builder {
 public:
  Builder(const Model<B>& model, TrueProblem<D, B>& out)
      : nodes_(out.linear), mesh_(out.mesh), model_(model), out_(out) {}

  void build() {
    add_elements();
    add_outer_faces();
    out_.edge_load.assign(static_cast<std::size_t>(out_.incidence.edges), {});
    add_thermal_stress();
    for (const Load<B>& given : model_.loads) {
      const Load<B> load = distributed(nodes_, model_, given);
      load.on ? add_traction(load) : add_source(load);
    }
    tell_oscillation();
    add_fixes();
    add_mirrors();
    fix_edges();
    for (const ObstacleTerm<B>& term : model_.obstacles) {
      if (term.other) {
        add_interface(term);
        continue;
      }
      Gaps<D, B>& of_term = out_.gaps.emplace_back(gaps(nodes_, model_, term, out_.incidence, out_.reasons));
      for (Index& f : of_term.faces) f = of_boundary_[f];
      if (of_term.friction) keep_slip(of_term);
    }
    if (out_.interfaces.empty()) return;
    std::vector<Index> sides;
    for (const OuterFace<D, B>& outer : out_.outer) sides.push_back(outer.face);
    out_.jumps.build(mesh_, out_.incidence, sides, out_.interfaces);
  }

 private:
  void add_elements() {
    const MaterialLaw<B> law(model_);
    if (!law.constant())
      for (Index e = 0; e < static_cast<Index>(mesh_.elements.size()); ++e) check_material(law, e);
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      out_.element.push_back(linear_element(mesh_, mesh_.elements[e]));
      Site where;
      if (!law.constant()) where = site_in<D>(mesh_, e, model_.t);
      out_.material.push_back(law.at(where));
    }
    out_.source.assign(mesh_.elements.size(), {});
  }

  void check_material(const MaterialLaw<B>& law, Index e) {
    const Material<B> middle = law.at(site_in<D>(mesh_, e, model_.t));
    for (const Index p : mesh_.elements[e]) {
      const Material<B> here = law.at(site_in<D>(mesh_, e, nearly(p, e), model_.t));
      if (differs(here, middle)) return out_.reasons.add("coefficients change within elements");
    }
  }
  /// Near a vertex inside an element, so that it belongs to this element's side of a jump.
  Point<D> nearly(Index p, Index e) const {
    const Point<D> c = centroid<D>(mesh_, mesh_.elements[e]);
    Point<D> x;
    for (int i = 0; i < D; ++i) x[i] = 0.9 * mesh_.points[p][i] + 0.1 * c[i];
    return x;
  }
  static bool differs(const Material<B>& a, const Material<B>& b) {
    if constexpr (B == 1)
      return std::fabs(a.diffusion - b.diffusion) > same_value * b.diffusion;
    else
      return std::fabs(a.mu - b.mu) > same_value * b.mu ||
             std::fabs(a.lambda - b.lambda) > same_value * (b.lambda + b.mu);
  }

  /// Faces on planes of symmetry are not in the mesh's boundary.
  void add_outer_faces() {
    const Incidence<D>& incidence = out_.incidence;
    out_.outer_of_face.assign(incidence.sides.size(), -1);
    const std::vector<Index> faces = boundary_faces(mesh_, incidence);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!incidence.sides[faces[f]].outer()) out_.reasons.add("the mesh has boundary faces inside");
      of_boundary_.push_back(add_outer(faces[f]));
      if (mesh_.boundary[f].curve >= 0)
        out_.reasons.add_geometry(
            "the boundary is curved: the bounds are for the polyhedron that the mesh makes of it");
    }
    for (Index f = 0; f < incidence.faces(); ++f)
      if (incidence.sides[f].outer() && out_.outer_of_face[f] < 0) on_mirrors_.push_back(add_outer(f));
  }
  Index add_outer(Index face) {
    const auto number = static_cast<Index>(out_.outer.size());
    OuterFace<D, B>& outer = out_.outer.emplace_back();
    outer.face = face;
    const auto& side = out_.incidence.sides[face];
    const LinearElement<D>& element = out_.element[side.element[0]];
    for (int i = 0; i < D; ++i) outer.normal[i] = -D * element.measure * element.gradient[side.opposite[0]][i];
    out_.outer_of_face[face] = number;
    return number;
  }

  /// A thermal stress k that is the same all over a body does what a traction k n on all of its boundary does: div(k I)
  /// is zero.
  void add_thermal_stress() {
    if constexpr (B == D) {
      const ThermalStrain<B> thermal(model_);
      if (thermal.none()) return;
      std::vector<double> stress;
      for (Index e = 0; e < out_.elements(); ++e)
        stress.push_back(
            thermal_stress(out_.material[e], thermal.at(site_in<D>(mesh_, e, model_.t)), has_plane_stress(model_)));
      if (!is_uniform(thermal, stress))
        out_.reasons.refuse("thermal strains and stresses that change from place to place in a body are not covered");
      for (OuterFace<D, B>& outer : out_.outer) press(outer, stress[out_.incidence.sides[outer.face].element[0]]);
    }
  }
  bool is_uniform(const ThermalStrain<B>& thermal, const std::vector<double>& stress) const {
    const auto differ = [](double a, double b) {
      return std::fabs(a - b) > same_value * std::max(std::fabs(a), std::fabs(b));
    };
    for (const auto& sides : out_.incidence.sides)
      if (!sides.outer() && differ(stress[sides.element[0]], stress[sides.element[1]])) return false;
    for (Index e = 0; e < out_.elements() && !thermal.constant(); ++e) {
      const double middle = thermal.at(site_in<D>(mesh_, e, model_.t));
      for (const Index p : mesh_.elements[e])
        if (differ(thermal.at(site_in<D>(mesh_, e, nearly(p, e), model_.t)), middle)) return false;
    }
    return true;
  }
  /// Adds a traction k n.
  void press(OuterFace<D, B>& outer, double k) {
    const auto vertices = face_vertices<D>(mesh_, out_.incidence.sides[outer.face]);
    for (auto& load : outer.load) add(k / D, outer.normal, load);
    for (const auto [a, b] : simplex_edges<D - 1>())
      add(4 * k / (D * (D + 1)), outer.normal, out_.edge_load[edge_of(outer, vertices[a], vertices[b])]);
  }

  void add_source(const Load<B>& load) {
    const auto [first, last] = load.regions;
    if (!is_constant(load) && B == 1) need_moments();
    for (Index e = 0; e < out_.elements(); ++e) {
      const Index region = nodes_.region(e);
      if (first >= 0 && (region < first || region > last)) continue;
      const double measure = out_.element[e].measure;
      const OnSimplex<D, D, B> on(load, corners<D>(mesh_.points, mesh_.elements[e]), site<D>({}, model_.t));
      add(1, on.mean, out_.source[e]);
      for (int a = 0; a <= D && !out_.source_moment.empty(); ++a)
        add(measure, on.moment[a], out_.source_moment[Offset{e} * (D + 1) + a]);
      for (std::size_t k = 0; k < on.of_edge.size(); ++k)
        add(measure, on.of_edge[k],
            out_.edge_load[out_.incidence.edge[static_cast<std::size_t>(e) * on.of_edge.size() + k]]);
      // Payne and Weinberger: the constant of a convex domain is its diameter over pi.
      const double h = longest_edge<D>(corners<D>(mesh_.points, mesh_.elements[e]));
      note(e, on.square > 0, h / std::numbers::pi * std::sqrt(measure * on.square));
      check_linear(load, on.off, on.largest);
    }
  }

  void need_moments() {
    if (!out_.source_moment.empty()) return;
    for (Index e = 0; e < out_.elements(); ++e)
      for (int a = 0; a <= D; ++a) moments_.push_back(out_.moment(e, a));
    out_.source_moment = std::move(moments_);
  }

  void add_traction(const Load<B>& load) {
    for (const Index f : select_faces(mesh_, *load.on, model_.t)) {
      OuterFace<D, B>& outer = out_.outer[of_boundary_[f]];
      const auto vertices = face_vertices<D>(mesh_, out_.incidence.sides[outer.face]);
      Point<D> normal = outer.normal;
      const double measure = normalise(normal);
      const OnSimplex<D, D - 1, B> on(load, points_of(mesh_, vertices), site<D>({}, model_.t, normal));
      for (int k = 0; k < D; ++k) add(measure, on.moment[k], outer.load[k]);
      constexpr auto edges = simplex_edges<D - 1>();
      for (std::size_t k = 0; k < edges.size(); ++k)
        add(measure, on.of_edge[k], out_.edge_load[edge_of(outer, vertices[edges[k][0]], vertices[edges[k][1]])]);
      const Index e = out_.incidence.sides[outer.face].element[0];
      if (B == 1) note(e, on.square > 0, trace_constant(e, measure) * std::sqrt(measure * on.square));
      check_linear(load, on.off, on.largest);
    }
  }

  /// |w|_F <= c |grad w|_T for w without mean over T, from integrating div(w^2 (x - x_F)), x_F opposite to F:
  /// |w|_F^2 <= |F|/|T| |w| (|w| + 2 h/D |grad w|), and |w| <= h/pi |grad w|.
  double trace_constant(Index e, double measure_of_face) const {
    const double h = longest_edge<D>(corners<D>(mesh_.points, mesh_.elements[e])), poincare = h / std::numbers::pi;
    return std::sqrt(measure_of_face / out_.element[e].measure * poincare * (poincare + 2 * h / D));
  }

  Index edge_of(const OuterFace<D, B>& outer, Index p, Index q) const {
    constexpr auto edges = simplex_edges<D>();
    const Index e = out_.incidence.sides[outer.face].element[0];
    const Simplex<D>& v = mesh_.elements[e];
    std::size_t k = 0;
    while (!((v[edges[k][0]] == p && v[edges[k][1]] == q) || (v[edges[k][0]] == q && v[edges[k][1]] == p))) ++k;
    return out_.incidence.edge[static_cast<std::size_t>(e) * edges.size() + k];
  }

  void note(Index e, bool oscillates, double part) {
    if (!oscillates) return;
    if (out_.oscillation.empty()) out_.oscillation.assign(mesh_.elements.size(), 0);
    if constexpr (B == 1) out_.oscillation[e] += part / std::sqrt(out_.material[e].diffusion);
  }
  void check_linear(const Load<B>& load, double off, double largest) {
    if (!(off > same_value * largest)) return;
    std::vector<std::string> components;
    for (const Field& component : load.value) components.push_back(component.text());
    out_.reasons.add(fmt::format("the load '{}' is not linear within elements: integrals of it are approximate",
                                 fmt::join(components, ", ")));
  }
  void tell_oscillation() {
    if (B > 1 && !out_.oscillation.empty()) {
      out_.reasons.add("a body force changes from place to place, which the bounds for elastic bodies do not cover");
      out_.oscillation.clear();
    }
  }

  void add_fixes() {
    for (std::size_t k = 0; k < model_.fixes.size(); ++k)
      for (const Index f : select_faces(mesh_, model_.fixes[k].on, model_.t))
        fix(model_.fixes[k], static_cast<Index>(k), out_.outer[of_boundary_[f]]);
    if (off_ > same_value * largest_)
      out_.reasons.add(
          "prescribed values are not linear on faces (of quadratic elements not quadratic): the bounds are for their "
          "interpolation");
  }

  void fix(const Fix<B>& fix, Index number, OuterFace<D, B>& outer) {
    Point<D> normal = outer.normal;
    normalise(normal);
    for (int i = 0; i < B; ++i) {
      if (!fix.value[i]) continue;
      const auto direction = directions<D, B>(fix.frame, {}, normal)[i];
      compare(*fix.value[i], direction, normal, outer);
      outer.fixed.add(direction.data(), 0, number);
    }
  }

  /// The finite element function with what is prescribed, at vertices and midpoints of a face.
  void compare(const Field& field, const std::array<double, B>& direction, const Point<D>& normal,
               const OuterFace<D, B>& outer) {
    const auto vertices = face_vertices<D>(mesh_, out_.incidence.sides[outer.face]);
    const QuadraticFunction& u = out_.u;
    const auto component = [&](const std::vector<double>& of, Index p) {
      double sum = 0;
      for (int i = 0; i < B && !of.empty(); ++i) sum += direction[i] * of[Offset{p} * B + i];
      return sum;
    };
    for (int a = 0; a < D; ++a)
      for (int b = 0; b <= a; ++b) {
        const Point<D> x = midpoint<D>(mesh_.points[vertices[a]], mesh_.points[vertices[b]]);
        const double wanted = field(site<D>(x, model_.t, normal));
        const double linear = (component(u.at_vertex, vertices[a]) + component(u.at_vertex, vertices[b])) / 2;
        const double bubble = a == b ? 0 : component(u.of_edge, edge_of(outer, vertices[a], vertices[b]));
        off_ = std::max(off_, std::fabs(wanted - linear - bubble));
        largest_ = std::max(largest_, std::fabs(wanted));
      }
    for (const double v : u.at_vertex) largest_ = std::max(largest_, first_ ? std::fabs(v) : 0);
    first_ = false;
  }

  void add_mirrors() {
    if constexpr (B == D)
      for (const Index number : on_mirrors_) {
        Point<D> normal = out_.outer[number].normal;
        normalise(normal);
        out_.outer[number].fixed.add(normal.data(), 0, -1);
      }
  }

  void fix_edges() {
    out_.edge_fix.assign(static_cast<std::size_t>(out_.incidence.edges), -1);
    for (const OuterFace<D, B>& outer : out_.outer)
      if (!outer.open())
        fix_edges(outer, [&](FixedDirections<B>& fixes, Index) {
          for (int k = 0; k < outer.fixed.count; ++k) fixes.add(outer.fixed.direction[k], 0, 0);
        });
  }
  /// Calls add(directions, edge) for the edges of a face.
  template <class Add>
  void fix_edges(const OuterFace<D, B>& outer, const Add& add) {
    const auto vertices = face_vertices<D>(mesh_, out_.incidence.sides[outer.face]);
    for (const auto [a, b] : simplex_edges<D - 1>()) {
      const Index edge = edge_of(outer, vertices[a], vertices[b]);
      Index& number = out_.edge_fix[edge];
      if (number < 0) {
        number = static_cast<Index>(out_.edge_fixes.size());
        out_.edge_fixes.emplace_back();
      }
      add(out_.edge_fixes[number], edge);
    }
  }

  void add_interface(const ObstacleTerm<B>& term) {
    if constexpr (B == D) {
      ContactInterface<D>& added =
          out_.interfaces.emplace_back(contact_interface<D>(mesh_, model_, term, out_.reasons));
      for (FacingPiece<D>& piece : added.pieces) {
        piece.slave = of_boundary_[piece.slave];
        piece.master = of_boundary_[piece.master];
      }
      if (!added.law.empty()) keep_slip(added);
    }
  }

  /// Bubbles with friction move along the obstacle's direction alone: what friction takes stays what it is.
  void keep_slip(const Gaps<D, B>& gaps) {
    for (const Index number : gaps.faces)
      keep_slip(number, [&](Index edge) {
        const auto* bound = gaps.at_edge(edge);
        return bound ? &bound->direction : nullptr;
      });
  }
  void keep_slip(const ContactInterface<D>& between) requires(B == D) {
    for (const FacingPiece<D>& piece : between.pieces)
      for (const Index number : {piece.slave, piece.master}) keep_slip(number, [&](Index) { return &between.normal; });
  }
  /// @param direction of an edge; null: it may move
  template <class Direction>
  void keep_slip(Index number, const Direction& direction) {
    const OuterFace<D, B>& outer = out_.outer[number];
    if (!outer.open()) out_.reasons.add("friction on faces where something is prescribed is not covered");
    fix_edges(outer, [&](FixedDirections<B>& fixes, Index edge) {
      const std::array<double, B>* n = direction(edge);
      for (int k = 0; n && k < B; ++k) {
        std::array<double, B> along{};
        along[k] = 1;
        for (int i = 0; i < B; ++i) along[i] -= (*n)[k] * (*n)[i];
        const double size = std::sqrt(dot(along, along));
        if (!(size > same_direction)) continue;
        for (double& c : along) c /= size;
        fixes.add(along.data(), 0, 0);
      }
    });
  }

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  const Model<B>& model_;
  TrueProblem<D, B>& out_;
  std::vector<Index> of_boundary_, on_mirrors_;  // numbers of outer faces
  std::vector<std::array<double, B>> moments_;
  double off_ = 0, largest_ = 0;
  bool first_ = true;
};

}  // namespace

template <int D, int B>
TrueProblem<D, B>::TrueProblem(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                               const std::vector<double>& rest)
    : mesh(nodes.mesh()), linear(mesh), incidence(mesh), u(quadratic_function<D, B>(nodes, incidence, u)) {
  Builder<D, B>(model, *this).build();
  if (!friction()) return;
  if (friction_between() && std::ranges::any_of(rest, [](double x) { return x != 0; }))
    reasons.add("friction between bodies counts from where they were at rest, which is known at nodes only");
  std::vector<double> moved = u;
  for (std::size_t i = 0; i < rest.size(); ++i) moved[i] -= rest[i];
  slip = quadratic_function<D, B>(nodes, incidence, moved);
}

template struct TrueProblem<2, 1>;
template struct TrueProblem<3, 1>;
template struct TrueProblem<2, 2>;
template struct TrueProblem<3, 3>;

}  // namespace signorini
