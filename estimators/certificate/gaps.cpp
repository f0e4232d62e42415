#include "estimators/certificate/gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/component/failure.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "estimators/certificate/friction_laws.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-13;  // of the largest number, for differences of bounds

/// Asks one obstacle at vertices, at the middles of edges, and at points that tell whether it is quadratic between.
template <int D, int B>
class Asked {
 public:
  Asked(const Nodes<D>& nodes, const Model<B>& model, const ObstacleTerm<B>& term, const Incidence<D>& incidence)
      : mesh_(nodes.mesh()), term_(term), incidence_(incidence) {
    ends_.resize(static_cast<std::size_t>(incidence.edges), {-1, -1});
    if (term.on)
      faces_ = select_faces(mesh_, *term.on, model.t);
    else if (B > 1)
      faces_ = surface(nodes).faces;
    surface_ = surface(nodes, faces_.empty() ? surface(nodes).faces : faces_);
    normals_ = node_normals(nodes, surface_);
    find_edges();
  }

  void ask(Gaps<D, B>& out, Reasons& reasons) {
    for (Index p = 0; p < mesh_.vertices(); ++p)
      if (reached_vertex(p)) push(mesh_.points[p], normal_at(p));
    const std::size_t vertices = points_.size();
    for (const double part : {0.5, 0.25})
      for (Index e = 0; e < incidence_.edges; ++e)
        if (ends_[e][0] >= 0) push_on_edge(e, part);
    const std::size_t edges = (points_.size() - vertices) / 2;
    if (!evaluate(reasons)) return;
    check_directions(reasons);
    take(out, vertices, edges, reasons);
    out.in_body = faces_.empty();
    out.faces = faces_;
    out.friction = term_.obstacle->friction() != nullptr;
    if (std::ranges::any_of(out.bounds, [](const auto& bound) { return bound.law.coefficient > 0; }))
      tell_frozen(term_.origin, reasons);
  }

 private:
  bool in_body() const { return faces_.empty(); }
  bool reached_vertex(Index p) const { return in_body() || std::ranges::binary_search(surface_.nodes, p); }
  Point<D> normal_at(Index p) const {
    const auto found = std::ranges::lower_bound(surface_.nodes, p);
    return found != surface_.nodes.end() && *found == p ? normals_[found - surface_.nodes.begin()] : Point<D>{};
  }

  void find_edges() {
    constexpr auto local = simplex_edges<D>();
    const auto take = [&](Index e, std::size_t k) {
      const Simplex<D>& v = mesh_.elements[e];
      ends_[incidence_.edge[Offset{e} * static_cast<Offset>(local.size()) + static_cast<Offset>(k)]] = {v[local[k][0]],
                                                                                                        v[local[k][1]]};
    };
    if (in_body()) {
      for (Index e = 0; e < static_cast<Index>(mesh_.elements.size()); ++e)
        for (std::size_t k = 0; k < local.size(); ++k) take(e, k);
      return;
    }
    for (const Index f : faces_) {
      const Face<D>& face = mesh_.boundary[f];
      const auto on_face = [&](Index p) { return std::ranges::find(face.vertices, p) != face.vertices.end(); };
      for (std::size_t k = 0; k < local.size(); ++k)
        if (const Simplex<D>& v = mesh_.elements[face.element]; on_face(v[local[k][0]]) && on_face(v[local[k][1]]))
          take(face.element, k);
    }
  }

  void push(const Point<D>& x, const Point<D>& normal) {
    SurfaceVertex& vertex = points_.emplace_back();
    vertex = {};
    vertex.measure = 1;  // what obstacles know of friction is then per area
    std::ranges::copy(x, vertex.position);
    std::ranges::copy(normal, vertex.normal);
  }
  void push_on_edge(Index e, double part) {
    const auto [a, b] = ends_[e];
    Point<D> x, normal = normal_at(a);
    const Point<D> other = normal_at(b);
    for (int i = 0; i < D; ++i) {
      x[i] = (1 - part) * mesh_.points[a][i] + part * mesh_.points[b][i];
      normal[i] += other[i];
    }
    normalise(normal);
    push(x, normal);
  }

  bool evaluate(Reasons& reasons) {
    found_.assign(points_.size(), LocalConstraint<B>{});
    Status status;
    term_.obstacle->assemble(points_.data(), points_.size(), found_.data(), status);
    const bool one = std::ranges::all_of(found_, [](const LocalConstraint<B>& c) { return c.directions <= 1; });
    if (!status.ok()) reasons.refuse(fmt::format("{} cannot be asked between nodes", term_.origin));
    if (!one) reasons.refuse(fmt::format("{} bounds several directions", term_.origin));
    return status.ok() && one;
  }

  void check_directions(Reasons& reasons) const {
    const LocalConstraint<B>* first = nullptr;
    for (const LocalConstraint<B>& c : found_) {
      if (c.directions == 0) continue;
      if (!first) first = &c;
      for (int i = 0; i < B; ++i)
        if (std::fabs(c.direction[0][i] - first->direction[0][i]) > same_value)
          return reasons.add_geometry(fmt::format(
              "{} pushes along directions that change from place to place: between nodes that of their mean "
              "takes its place",
              term_.origin));
    }
  }

  void take(Gaps<D, B>& out, std::size_t vertices, std::size_t edges, Reasons& reasons) const {
    out.of_vertex.assign(static_cast<std::size_t>(mesh_.vertices()), -1);
    out.of_edge.assign(static_cast<std::size_t>(incidence_.edges), -1);
    double largest = 0;
    std::size_t k = 0;
    for (Index p = 0; p < mesh_.vertices(); ++p)
      if (reached_vertex(p)) {
        const LocalConstraint<B>& c = found_[k++];
        if (c.directions == 0) continue;
        out.of_vertex[p] = static_cast<Index>(out.bounds.size());
        out.bounds.push_back({direction(c), c.lower[0], c.upper[0], law(c)});
        for (const double bound : {c.lower[0], c.upper[0]})
          if (std::isfinite(bound)) largest = std::max(largest, std::fabs(bound));
      }
    largest = largest_number(largest);
    out.rounding = rounding * largest;
    double off = 0;
    k = vertices;
    for (Index e = 0; e < incidence_.edges; ++e) {
      if (ends_[e][0] < 0) continue;
      const LocalConstraint<B>&middle = found_[k], &quarter = found_[k + edges];
      ++k;
      const Index a = out.of_vertex[ends_[e][0]], b = out.of_vertex[ends_[e][1]];
      if (a < 0 || b < 0 || middle.directions == 0) continue;
      out.of_edge[e] = static_cast<Index>(out.bounds.size());
      const auto at_edge = [&](double of_a, double of_b, double half, double first) {
        const double bubble = half - (of_a + of_b) / 2;
        if (std::isfinite(bubble)) off = std::max(off, std::fabs(first - 0.75 * (of_a + bubble) - 0.25 * of_b));
        return bubble;
      };
      const typename Gaps<D, B>::Bound from = out.bounds[a], to = out.bounds[b];
      out.bounds.push_back({direction(middle), at_edge(from.lower, to.lower, middle.lower[0], quarter.lower[0]),
                            at_edge(from.upper, to.upper, middle.upper[0], quarter.upper[0])});
      check_linear(from.law, to.law, law(middle), term_.origin, reasons);
    }
    if (!(off <= same_value * largest))
      reasons.add(fmt::format("{} is neither linear nor quadratic between nodes: a quadratic function takes its place",
                              term_.origin));
  }

  double largest_number(double largest) const {
    for (const Point<D>& x : mesh_.points)
      if (B > 1) largest = std::max(largest, length<D>(x));
    return largest;
  }

  FrictionLaw law(const LocalConstraint<B>& c) const { return law_of(*term_.obstacle, c); }
  static std::array<double, B> direction(const LocalConstraint<B>& c) {
    std::array<double, B> out;
    std::copy_n(c.direction[0], B, out.begin());
    return out;
  }

  const Mesh<D>& mesh_;
  const ObstacleTerm<B>& term_;
  const Incidence<D>& incidence_;
  std::vector<std::array<Index, 2>> ends_;  // per edge that it reaches
  std::vector<Index> faces_;                // none: it acts in the body
  Surface<D> surface_;
  std::vector<Point<D>> normals_;
  std::vector<SurfaceVertex> points_;
  std::vector<LocalConstraint<B>> found_;
};

}  // namespace

template <int D, int B>
Gaps<D, B> gaps(const Nodes<D>& nodes, const Model<B>& model, const ObstacleTerm<B>& term,
                const Incidence<D>& incidence, Reasons& reasons) {
  Gaps<D, B> out;
  Asked<D, B>(nodes, model, term, incidence).ask(out, reasons);
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template Gaps<D, B> gaps(const Nodes<D>&, const Model<B>&, const ObstacleTerm<B>&, const Incidence<D>&, Reasons&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
