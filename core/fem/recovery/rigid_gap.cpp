#include "core/fem/recovery/rigid_gap.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/base/dense.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/geometry/faceted_distance.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double of_tolerance = 1e-6;                      // of displacements: what tolerances leave, and rounding
constexpr double of_displacement = 0.01, of_depth = 0.05;  // what is noticeable
constexpr Index few = 2;                                   // vertices that touch: these flatten nothing
constexpr double many = 0.1;                               // of the nodes in contact
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// Distance of a node to an obstacle and the direction away from it.
template <int D>
struct Gap {
  Index node;
  double distance;
  Point<D> normal;
};

template <int D>
Surface<D> faces_of(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, bool everywhere) {
  const ObstacleTerm<D>& term = model.obstacles[obstacle];
  return term.on && !everywhere ? surface(nodes, select_faces(nodes.mesh(), *term.on, model.t)) : surface(nodes);
}

/// A boundary alone, displaced by u.
template <int D>
Mesh<D> displaced(const Nodes<D>& nodes, const std::vector<double>& u) {
  Mesh<D> out;
  out.points = displaced_points(nodes, u);
  out.boundary = nodes.mesh().boundary;
  return out;
}

/// The bound that is nearest, or violated most.
template <int D>
Gap<D> gap(Index node, const LocalConstraint<D>& constraint) {
  Gap<D> out{node, infinity, {}};
  for (int k = 0; k < constraint.directions; ++k)
    for (const double sign : {1.0, -1.0}) {
      const double distance = sign > 0 ? -constraint.lower[k] : constraint.upper[k];
      if (distance >= out.distance) continue;
      out.distance = distance;
      for (int i = 0; i < D; ++i) out.normal[i] = sign * constraint.direction[k][i];
    }
  return out;
}

/// What an obstacle says of some nodes; empty where it fails.
template <int D>
std::vector<Gap<D>> gaps(const std::vector<SurfaceVertex>& vertices, const std::vector<Index>& nodes,
                         const ObstacleTerm<D>& term) {
  std::vector<LocalConstraint<D>> constraints(vertices.size());
  Status status;
  term.obstacle->assemble(vertices.data(), vertices.size(), constraints.data(), status);
  std::vector<Gap<D>> out;
  for (std::size_t v = 0; v < vertices.size() && status.ok(); ++v) out.push_back(gap<D>(nodes[v], constraints[v]));
  return out;
}

/// A point of the slave as obstacles between bodies see it.
template <int D>
SurfaceVertex pair_vertex(const Point<D>& x, double gap, const Point<D>& normal) {
  SurfaceVertex v{};
  v.gap = gap;
  for (int i = 0; i < D; ++i) {
    v.position[i] = x[i];
    v.normal[i] = normal[i];
    v.away[i] = -normal[i];
  }
  return v;
}

/// To a rigid obstacle, by ascending node; empty where it fails.
template <int D>
std::vector<Gap<D>> gaps(const Nodes<D>& nodes, const Surface<D>& at, const ObstacleTerm<D>& term) {
  const std::vector<Point<D>> normals = node_normals(nodes, at);
  std::vector<SurfaceVertex> vertices(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    std::copy_n(nodes.at(at.nodes[v]).data(), D, vertices[v].position);
    std::copy_n(normals[v].data(), D, vertices[v].normal);
  }
  return gaps(vertices, at.nodes, term);
}

/// To the other body, where displacements take both, by ascending node: means, but none beyond what they are means of.
template <int D>
std::vector<Gap<D>> pair_gaps(const Nodes<D>& nodes, const MortarCoupling<D>& coupling, const ObstacleTerm<D>& term) {
  std::vector<SurfaceVertex> vertices(coupling.node.size());
  std::vector<Index> at;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    at.push_back(nodes.of_vertex(coupling.node[k]));
    const double mean = coupling.gap[k] / coupling.part(static_cast<Index>(k));
    vertices[k] = pair_vertex<D>(nodes.at(at.back()), std::clamp(mean, coupling.nearest[k], coupling.farthest[k]),
                                 coupling.normal[k]);
  }
  std::vector<Gap<D>> out = gaps(vertices, at, term);
  std::ranges::sort(out, {}, &Gap<D>::node);
  return out;
}

template <int D>
double size_at(const std::vector<double>& u, Index p) {
  double square = 0;
  for (int i = 0; i < D; ++i) square += u[Offset{p} * D + i] * u[Offset{p} * D + i];
  return std::sqrt(square);
}

/// The box around displacements.
template <int D>
class Range {
 public:
  Range() {
    low_.fill(infinity);
    high_.fill(-infinity);
  }
  void add(const double* u) {
    for (int i = 0; i < D; ++i) {
      low_[i] = std::min(low_[i], u[i]);
      high_[i] = std::max(high_[i], u[i]);
    }
  }
  double diagonal() const { return length<D>(difference<D>(high_, low_)); }

 private:
  Point<D> low_, high_;
};

template <int D>
double difference_of_displacements(const std::vector<double>& u) {
  Range<D> range;
  for (std::size_t k = 0; k < u.size(); k += D) range.add(u.data() + k);
  return range.diagonal();
}

/// Of the faces of one side.
template <int D>
double difference_of_displacements(const Surface<D>& side, const std::vector<double>& u) {
  Range<D> range;
  for (const Index p : side.nodes) range.add(u.data() + Offset{p} * D);
  return side.nodes.empty() ? 0 : range.diagonal();
}

/// Whether most of what the obstacle's normal turns by, along the way of a node, it turns at one place: halves of the
/// way, of which each time the one is kept over which it turns more.
template <int D>
bool turns_at_once(const Nodes<D>& nodes, const Surface<D>& at, Index p, const ObstacleTerm<D>& term,
                   const std::vector<double>& u) {
  constexpr int halves = 8;
  constexpr double most = 0.5, least = 1e-6;
  const auto place = std::ranges::lower_bound(at.nodes, p) - at.nodes.begin();
  SurfaceVertex v{};
  std::copy_n(node_normals(nodes, at)[static_cast<std::size_t>(place)].data(), D, v.normal);
  const auto normal = [&](double part) {
    for (int i = 0; i < D; ++i) v.position[i] = nodes.at(p)[i] + part * u[Offset{p} * D + i];
    const std::vector<Gap<D>> there = gaps<D>({v}, {p}, term);
    return there.empty() ? Point<D>{} : there.front().normal;
  };
  const auto turn = [](Point<D> a, const Point<D>& b) {
    for (int i = 0; i < D; ++i) a[i] -= b[i];
    return length<D>(a);
  };
  double from = 0, to = 1;
  Point<D> before = normal(from), after = normal(to);
  const double whole = turn(before, after);
  for (int k = 0; k < halves; ++k) {
    const double middle = (from + to) / 2;
    const Point<D> between = normal(middle);
    const bool first = turn(before, between) > turn(between, after);
    (first ? to : from) = middle;
    (first ? after : before) = between;
  }
  return whole > least && turn(before, after) > most * whole;
}

/// See DeformedContact. The motion of all vertices is the one next to what they have come by, in the mean.
template <int D>
double depth(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& state, Index obstacle,
             double displacement) {
  const auto admitted = [&](const ContactNode<D>& node) {
    return symmetric_motion<D>(nodes.mesh(), model.plane, node.direction);
  };
  std::vector<const ContactNode<D>*> touch;
  Eigen::Matrix<double, D, D> square = Eigen::Matrix<double, D, D>::Zero();
  Eigen::Matrix<double, D, 1> right = Eigen::Matrix<double, D, 1>::Zero();
  for (const ContactNode<D>& node : state.nodes) {
    if (!node.contact || node.obstacle != obstacle || !std::isfinite(node.start)) continue;
    touch.push_back(&node);
    const Point<D> direction = admitted(node);
    const Eigen::Map<const Eigen::Matrix<double, D, 1>> n(direction.data());
    square += n * n.transpose();
    right += node.start * n;
  }
  if (touch.empty()) return 0;
  square.diagonal().array() += of_tolerance * static_cast<double>(touch.size());  // along what no normal has a part
  const Eigen::Matrix<double, D, 1> common = SymmetricFactors(square).solve(right);
  double least = infinity, most = -infinity;
  for (const ContactNode<D>* node : touch) {
    const Point<D> direction = admitted(*node);
    const double by = node->start - Eigen::Map<const Eigen::Matrix<double, D, 1>>(direction.data()).dot(common);
    least = std::min(least, by);
    most = std::max(most, by);
  }
  return most - least > of_tolerance * std::max(common.norm(), displacement) ? most - least : 0;
}

/// See DeformedContact::off.
double off(const DeformedContact& contact, Index touching, double deformed, bool rigid) {
  const double by = std::max(contact.penetration, contact.opening), moved = contact.displacement;
  if (!(moved > 0)) return 0;
  double flattened = infinity;  // nothing, where contact is flat; between bodies there are gaps beside their nodes
  if (contact.depth > 0 || touching <= few || rigid) flattened = std::max(deformed, of_tolerance * moved);
  if (contact.depth > 0) flattened = std::min(flattened, contact.depth);
  return by / std::min(of_displacement * moved, of_depth * flattened);
}

template <int B>
DeformedContact violation(const ContactState<B>& state, Index obstacle) {
  DeformedContact out;
  for (const ContactNode<B>& node : state.nodes)
    if (node.obstacle == obstacle) out.penetration = std::max(out.penetration, -node.gap);
  return out;
}

/// Of the nodes in contact those that are not among the ones that see the other body.
template <int D>
Index beyond(const ContactState<D>& state, Index obstacle, const std::vector<Gap<D>>& seen) {
  return static_cast<Index>(std::ranges::count_if(state.nodes, [&](const ContactNode<D>& node) {
    return node.obstacle == obstacle && node.contact &&
           !std::ranges::binary_search(seen, node.vertex, {}, &Gap<D>::node);
  }));
}

template <int D>
std::optional<DeformedContact> true_contact(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                            const ContactState<D>& state, const std::vector<double>& u) {
  const ObstacleTerm<D>& term = model.obstacles[obstacle];
  const Mesh<D> there = displaced(nodes, u);
  const Nodes<D> moved = nodes.on(there);
  const Surface<D> faces = term.other ? Surface<D>{} : faces_of(nodes, model, obstacle, false);
  auto all =
      term.other ? pair_gaps(nodes, couple_displaced(nodes, model, obstacle, u), term) : gaps(moved, faces, term);
  for (Gap<D>& gap : all) gap.distance -= std::clamp(gap.distance, -term.adjust, term.adjust);
  if (all.empty() && !term.other) return {};
  const auto* faceted = dynamic_cast<const geometry::FacetedDistance*>(term.shape.get());
  DeformedContact out;
  Index farthest = -1;
  auto node = state.nodes.begin();
  for (const Gap<D>& gap : all) {
    bool contact = false;
    while (node != state.nodes.end() && node->vertex < gap.node) ++node;
    for (; node != state.nodes.end() && node->vertex == gap.node; ++node)
      contact = contact || (node->contact && node->obstacle == obstacle);
    if constexpr (D == 3)
      if (contact && faceted) {
        out.sagitta = std::fmax(out.sagitta, faceted->sagitta_at(moved.at(gap.node).data()));
        const SmoothedOver over = faceted->smoothed_at(moved.at(gap.node).data());
        if (over.error() > out.smoothed.error()) out.smoothed = over;
      }
    const double off = contact ? std::abs(gap.distance) : -gap.distance;
    if (off > std::max(out.opening, out.penetration)) farthest = gap.node;
    if (contact) out.opening = std::max(out.opening, gap.distance);
    out.penetration = std::max(out.penetration, -gap.distance);
    if (contact || gap.distance < 0) out.displacement = std::max(out.displacement, size_at<D>(u, gap.node));
  }
  // Where a body is pressed from behind on something rigid it moves less than what presses it.
  out.displacement = std::max(out.displacement, difference_of_displacements<D>(u));
  out.depth = depth(nodes, model, state, obstacle, out.displacement);
  if (!term.other && farthest >= 0) out.over_edge = turns_at_once(nodes, faces, farthest, term, u);
  if (term.other) out.beyond = beyond(state, obstacle, all);
  const Surface<D> side = term.other ? surface(nodes, paired_faces(nodes.mesh(), term, model.t).slave) : faces;
  out.off = off(out, state.obstacles[obstacle].nodes, difference_of_displacements(side, u), !term.other);
  if (all.empty()) out.penetration = out.opening = out.displacement = not_there;
  return out;
}

/// Largest less least coordinate of some nodes along a direction.
template <int D>
double extent(const Nodes<D>& nodes, const std::vector<Index>& some, const std::type_identity_t<Point<D>>& along) {
  double low = infinity, high = -infinity;
  for (const Index p : some) {
    const double x = dot(nodes.at(p), along);
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high - low;
}

}  // namespace

double noticeably_beyond(Index beyond, Index touching) { return touching > 0 ? beyond / (many * touching) : 0; }

template <int D, int B>
std::optional<DeformedContact> deformed_contact(const Nodes<D>& nodes, const Model<B>& model, Index obstacle,
                                                const ContactState<B>& state, const std::vector<double>& u) {
  if constexpr (B == D)
    if (model.obstacles[obstacle].shape || model.obstacles[obstacle].other)
      return true_contact(nodes, model, obstacle, state, u);
  return violation(state, obstacle);
}

template <int D, int B>
std::vector<std::optional<DeformedContact>> deformed_contacts(const Nodes<D>& nodes, const Model<B>& model,
                                                              const ContactState<B>& state,
                                                              const std::vector<double>& u) {
  std::vector<std::optional<DeformedContact>> out(model.obstacles.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (!model.obstacles[k].tied) out[k] = deformed_contact(nodes, model, static_cast<Index>(k), state, u);
  return out;
}

template <int B>
double noticeably_off(const std::vector<std::optional<DeformedContact>>& deformed, const ContactState<B>& state) {
  double out = 0;
  for (std::size_t k = 0; k < deformed.size(); ++k)
    if (const auto& at = deformed[k])
      out = std::max({out, at->off, noticeably_beyond(at->beyond, state.obstacles[k].nodes)});
  return out;
}

template <int D>
std::optional<StartDepth> start_depth(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, bool everywhere) {
  const ObstacleTerm<D>& term = model.obstacles[obstacle];
  if (!term.shape) return {};
  const auto less = [](const Gap<D>& a, const Gap<D>& b) { return a.distance < b.distance; };
  const Surface<D> boundary = surface(nodes);
  const auto all = gaps(nodes, boundary, term);
  const auto asked = everywhere ? all : gaps(nodes, faces_of(nodes, model, obstacle, false), term);
  if (all.empty() || asked.empty()) return {};
  const auto [lowest, highest] = std::ranges::minmax_element(all, less);
  // of the body's extent
  const double least = rounding_of_differences * extent(nodes, boundary.nodes, lowest->normal);
  const bool completely = highest->distance <= least && lowest->distance < -least;
  const Gap<D> deepest = completely ? *lowest : *std::ranges::min_element(asked, less);
  return StartDepth{-deepest.distance, extent(nodes, boundary.nodes, deepest.normal), completely};
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                             \
  template std::optional<DeformedContact> deformed_contact(const Nodes<D>&, const Model<B>&, Index,             \
                                                           const ContactState<B>&, const std::vector<double>&); \
  template std::vector<std::optional<DeformedContact>> deformed_contacts(                                       \
      const Nodes<D>&, const Model<B>&, const ContactState<B>&, const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE
template double noticeably_off(const std::vector<std::optional<DeformedContact>>&, const ContactState<1>&);
template double noticeably_off(const std::vector<std::optional<DeformedContact>>&, const ContactState<2>&);
template double noticeably_off(const std::vector<std::optional<DeformedContact>>&, const ContactState<3>&);
template std::optional<StartDepth> start_depth(const Nodes<2>&, const Model<2>&, Index, bool);
template std::optional<StartDepth> start_depth(const Nodes<3>&, const Model<3>&, Index, bool);

}  // namespace signorini
