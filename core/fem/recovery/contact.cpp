#include "core/fem/recovery/contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/algebra/products.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/recovery/beside_slaves.hpp"
#include "core/fem/recovery/coincidence_set.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "core/fem/recovery/held_in_set.hpp"
#include "core/fem/recovery/meeting_faces.hpp"
#include "core/fem/recovery/pressure_recovery.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/force_split.hpp"
#include "core/solver/functional.hpp"

namespace signorini {
namespace {

constexpr double on_bound = rounding_of_differences;  // of the numbers compared
constexpr double at_rest = 1e-9;                      // of the largest displacement: what solvers leave of no motion

template <int B>
class NodeReader {
 public:
  NodeReader(const Discretization<B>& discretization, const std::vector<double>& x)
      : problem_(discretization.problem), discretization_(discretization), x_(x) {
    for (const double v : x) size_ = std::max(size_, std::fabs(v));
    gradient_ = functional::gradient(problem_, x);
    before_ = gradient_before();
  }

  // Direction k of a slot; only those that are bounded are read.
  bool bounded(Index slot, int k) const {
    return discretization_.lower_obstacle[Offset{slot} * B + k] >= 0 ||
           discretization_.upper_obstacle[Offset{slot} * B + k] >= 0;
  }

  ContactNode<B> read(Index slot, int k) const {
    const Offset at = Offset{slot} * B + k;
    const Index p = problem_.constraints.vector[slot];
    const double lower = problem_.constraints.lower[at], upper = problem_.constraints.upper[at];
    const double x = x_[Offset{p} * B + k], r = residual(p, k);
    const bool at_lower = touches(x - lower, lower), at_upper = touches(upper - x, upper);
    const bool below = discretization_.upper_obstacle[at] < 0 || nearer_to_lower(at, x, r, at_lower, at_upper);
    const Index obstacle = (below ? discretization_.lower_obstacle : discretization_.upper_obstacle)[at];
    const auto [normal, part] = whole(at, below, p, k);
    ContactNode<B> node = node_at(p, obstacle, at_lower || at_upper, false);
    node.gap = part * (below ? x - lower : upper - x);
    for (int i = 0; i < B; ++i) node.direction[i] = below ? normal[i] : -normal[i];
    push(node, std::max(below ? r : -r, 0.0) / part);  // what is left of the other sign is rounding
    node.shared = node.contact && discretization_.tied[at] != 0;
    return node;
  }

  bool has_facets(Index slot) const { return problem_.constraints.has_facets(slot); }

  /// The nodes of a slot with faces, among which the force is divided; one for each bounded direction.
  std::vector<ContactNode<B>> read_polyhedron(Index slot) const {
    const std::vector<Side> sides = this->sides(slot);
    std::vector<std::array<double, B>> directions;
    for (const Side& side : sides)
      if (side.touched) directions.push_back(side.direction);
    const ForceSplit split = split_force<B>(directions, pushing_force(slot));
    std::vector<ContactNode<B>> nodes;
    std::size_t touched = 0;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const Side& side = sides[k];
      ContactNode<B> node = node_at(problem_.constraints.vector[slot], side.obstacle, side.touched, false);
      node.gap = side.part * side.gap;
      node.direction = side.normal;
      if (side.touched) {
        push(node, split.part[touched] / side.part);
        node.shared = split.unknown[touched++];
      }
      // Of the two sides of one direction the one that presses more, or that is nearer.
      const bool same = k > 0 && sides[k - 1].number == side.number;
      if (!same)
        nodes.push_back(node);
      else if (node.pressure > nodes.back().pressure ||
               (node.pressure == nodes.back().pressure && node.gap < nodes.back().gap))
        nodes.back() = node;
    }
    return nodes;
  }

  /// Friction at a slot with a functional, to be added to what is known of its vertex. Where there is none what is left
  /// of a force along the surface is the solver's error.
  void add_friction(Index slot, const FrictionLaw& law, ContactNode<B>& node) const {
    const Index p = problem_.constraints.vector[slot];
    const double* Q = problem_.frames.at(p);
    node.friction = law.bound > 0 || (law.coefficient > 0 && node.contact);
    node.law = law;
    bool sticks = true;
    double work = 0, limits = 0;
    for (int k = 0; k < B; ++k) {
      if (!(problem_.constraints.tangential[slot] >> k & 1u)) continue;
      const double moved = x_[Offset{p} * B + k] - problem_.constraints.last[Offset{slot} * B + k];
      // What holds a prescribed component hides the force along it, and other obstacles what slips. (A pair of bodies
      // goes along with what is prescribed: without a motion along it, see rest_where_prescribed().)
      const bool hidden = has_facets(slot) || problem_.fixed[p] >> k & 1u;
      const double force = hidden ? -gradient_[Offset{slot} * B + k] : residual(p, k);
      sticks = sticks && std::fabs(moved) <= at_rest * size_;
      work += force * moved;
      limits += before_.empty() ? 0 : before_[Offset{slot} * B + k] * moved;
      for (int i = 0; i < B && node.friction; ++i) node.tangential[i] += force * (Q ? Q[i * B + k] : i == k ? 1 : 0);
    }
    // What slips does so at the limit, which goes from that of the last step to this one's. That is zero where contact
    // opens.
    if (!node.friction) {
      node.dissipated = sticks ? 0 : limits / 2;
      return;
    }
    node.sticks = sticks;
    // A given one has been there before the first step, which knows no last one.
    const bool first = law.bound > 0 && limits == 0;
    node.dissipated = sticks ? 0 : (std::max(-work, 0.0) + (first ? std::max(-work, 0.0) : limits)) / 2;
    if (has_facets(slot) && sticks) node.tangential = sticking_force(slot);
    for (int i = 0; i < B; ++i) node.force[i] += node.tangential[i];
  }

  /// What obstacles exert on the free components of a slot: with faces only what its functional does.
  std::array<double, B> force_of_functional(Index slot) const {
    const Index p = problem_.constraints.vector[slot];
    double local[B];
    for (int k = 0; k < B; ++k) {
      const bool hidden = has_facets(slot) || problem_.fixed[p] >> k & 1u;
      local[k] = hidden ? -gradient_[Offset{slot} * B + k] : residual(p, k);
    }
    return force_in_space(p, local);
  }

  /// What was between the two before anything moved; NaN where nothing is bounded.
  double start(const ContactNode<B>& node) const {
    const std::array<double, B> u = global(node.vertex);
    double moved = 0, square = 0;
    for (int i = 0; i < B; ++i) moved += u[i] * node.direction[i], square += node.direction[i] * node.direction[i];
    return square > 0 ? node.gap - moved : unknown_gap;
  }

  /// A vertex where a functional acts and nothing is bounded.
  ContactNode<B> free_node(Index slot) const {
    return node_at(problem_.constraints.vector[slot], discretization_.functional[slot], false, false);
  }

  ContactNode<B> read(const HeldBound<B>& held) const {
    const Bound<B>& bound = held.bound;
    double value = 0;
    const std::array<double, B> u = global(bound.vertex);
    for (int i = 0; i < B; ++i) value += bound.direction[i] * u[i];
    const double sign = value - bound.lower <= bound.upper - value ? 1 : -1;
    ContactNode<B> node = node_at(bound.vertex, bound.obstacle, true, true);
    node.direction = bound.direction;
    node.gap = std::min(value - bound.lower, bound.upper - value);
    for (double& d : node.direction) d *= sign;
    const PrescribedRows<B>& rows = discretization_.prescribed;
    push(node, sign * rows.force(rows.at(bound.vertex), held.along.data(), x_));
    if constexpr (B > 1) lead(held, u, node);
    return node;
  }

 private:
  static ContactNode<B> node_at(Index p, Index obstacle, bool contact, bool held) {
    ContactNode<B> node{};
    node.vertex = p;
    node.obstacle = obstacle;
    node.contact = contact;
    node.held = held;
    return node;
  }

  /// Friction at a node that is held and led along the obstacle.
  void lead(const HeldBound<B>& held, const std::array<double, B>& u, ContactNode<B>& node) const {
    std::array<double, B> slip;
    double across = 0, square = 0;
    for (int i = 0; i < B; ++i) across += (u[i] - held.last[i]) * node.direction[i];
    for (int i = 0; i < B; ++i) {
      slip[i] = u[i] - held.last[i] - across * node.direction[i];
      square += slip[i] * slip[i];
    }
    const double bound = held.law.bound + held.law.coefficient * std::max(node.pressure, 0.0), way = std::sqrt(square);
    if (!(bound > 0) || way <= at_rest * size_) return;
    node.friction = true;
    node.law = held.law;
    node.dissipated = bound * way;
    for (int i = 0; i < B; ++i) {
      node.tangential[i] = -bound * slip[i] / way;
      node.force[i] += node.tangential[i];
    }
  }

  /// One bound of a direction at a slot with faces.
  struct Side {
    int number;  ///< of the direction
    Index obstacle;
    bool touched;
    double gap;                       ///< of what is not prescribed
    std::array<double, B> direction;  ///< that it pushes along, of what is not prescribed
    std::array<double, B> normal;     ///< of the obstacle, the same way
    double part;                      ///< see ReducedBound
  };

  std::vector<Side> sides(Index slot) const {
    const Constraints<B>& c = problem_.constraints;
    const Index p = c.vector[slot];
    const double* x = x_.data() + Offset{p} * B;
    std::vector<Side> out;
    const auto add = [&](int number, bool upper, Index obstacle, double value, double bound,
                         const std::array<double, B>& direction, const std::array<double, B>& normal, double part) {
      if (obstacle < 0) return;
      const double gap = upper ? bound - value : value - bound;
      Side& side = out.emplace_back(Side{number, obstacle, touches(gap, bound), gap, direction, normal, part});
      if (!upper) return;
      for (double& d : side.direction) d = -d;
      for (double& d : side.normal) d = -d;
    };
    for (int k = 0; k < B; ++k)
      for (const bool upper : {false, true}) {
        const Offset at = Offset{slot} * B + k;
        double axis[B] = {};
        axis[k] = 1;
        const auto [normal, part] = whole(at, !upper, p, k);
        add(k, upper, (upper ? discretization_.upper_obstacle : discretization_.lower_obstacle)[at], x[k],
            (upper ? c.upper : c.lower)[at], force_in_space(p, axis), normal, part);
      }
    for (Offset f = c.facet_row[slot]; f < c.facet_row[slot + 1]; ++f) {
      const FacetSource<B>& source = discretization_.facets[f];
      const Facet<B>& face = c.facet[f];
      double value = 0;
      for (int k = 0; k < B; ++k) value += face.normal[k] * x[k];
      for (const bool upper : {false, true})
        add(B + static_cast<int>(f - c.facet_row[slot]), upper, source.obstacle[upper], value,
            upper ? face.upper : face.lower, force_in_space(p, face.normal), source.normal[upper], source.part[upper]);
    }
    return out;
  }

  /// What obstacles exert on the free components, but for friction that slips.
  std::array<double, B> pushing_force(Index slot) const {
    const Index p = problem_.constraints.vector[slot];
    double local[B];
    for (int k = 0; k < B; ++k) {
      local[k] = problem_.fixed[p] >> k & 1u ? 0 : residual(p, k);
      if (!gradient_.empty() && !(problem_.fixed[p] >> k & 1u)) local[k] += gradient_[Offset{slot} * B + k];
    }
    return force_in_space(p, local);
  }

  /// What is left of the force where nothing slips: friction.
  std::array<double, B> sticking_force(Index slot) const {
    std::array<double, B> force = pushing_force(slot);
    std::vector<std::array<double, B>> directions;
    for (const Side& side : sides(slot))
      if (side.touched) directions.push_back(side.direction);
    const ForceSplit split = split_force<B>(directions, force);
    for (std::size_t k = 0; k < directions.size(); ++k)
      for (int i = 0; i < B; ++i) force[i] -= split.part[k] * directions[k][i];
    return force;
  }

  std::array<double, B> force_in_space(Index p, const double* local) const {
    std::array<double, B> out;
    std::copy_n(local, B, out.begin());
    if (const double* N = problem_.frames.dual_at(p)) block::product<B>(N, local, out.data());
    return out;
  }

  // Likewise with the numbers that functionals had at the end of the last load step; empty without any.
  std::vector<double> gradient_before() const {
    if (gradient_.empty() || problem_.constraints.before.empty()) return {};
    LevelView<B> level = functional::view(problem_);
    level.data = problem_.constraints.before.data();
    level.x = const_cast<double*>(x_.data());
    std::vector<double> out(gradient_.size()), hessian(gradient_.size() * B);
    std::vector<double> lower(gradient_.size(), -infinity), upper(gradient_.size(), infinity);
    std::vector<Flags> critical(gradient_.size() / B);
    for (const Segment<B>& s : problem_.segments)
      if (const Linearisation<B>* phi = s.obstacle->linearisation())
        phi->linearise(level, s.first, s.last,
                       {out.data(), hessian.data(), lower.data(), upper.data(), critical.data()});
    return out;
  }

  // A x - b, of the component alone.
  double residual(Index p, int k) const {
    double Ax[B];
    row_product(problem_.A, p, x_.data(), Ax);
    return Ax[k] - problem_.b[Offset{p} * B + k];
  }

  // Where both bounds are touched the force tells which of them pushes.
  bool nearer_to_lower(Offset at, double x, double r, bool at_lower, bool at_upper) const {
    if (discretization_.lower_obstacle[at] < 0) return false;
    if (at_lower != at_upper) return at_lower;
    return at_lower ? r >= 0 : x - problem_.constraints.lower[at] <= problem_.constraints.upper[at] - x;
  }

  bool touches(double gap, double bound) const {
    return std::isfinite(bound) && gap <= on_bound * std::max(size_, std::fabs(bound));
  }

  // The obstacle pushes with this force.
  static void push(ContactNode<B>& node, double force) {
    if (!node.contact) return;
    node.pressure = force;
    for (int i = 0; i < B; ++i) node.force[i] = force * node.direction[i];
  }

  // The obstacle's normal and how much of it the local component k measures, which is all but for prescribed parts.
  std::pair<std::array<double, B>, double> whole(Offset at, bool below, Index p, int k) const {
    const auto& all = discretization_.reduced;
    auto found = std::partition_point(all.begin(), all.end(), [at](const auto& r) { return r.at < at; });
    if (found != all.end() && found->at == at) {
      if (found->upper == below) ++found;
      return {found->normal, found->part};
    }
    std::array<double, B> direction{};
    const double* N = problem_.frames.dual_at(p);
    for (int i = 0; i < B; ++i) direction[i] = N ? N[i * B + k] : (i == k ? 1 : 0);
    return {direction, 1};
  }

  std::array<double, B> global(Index p) const {
    std::array<double, B> u;
    std::copy_n(x_.begin() + Offset{p} * B, B, u.begin());
    if (const double* Q = problem_.frames.at(p)) block::product<B>(Q, x_.data() + Offset{p} * B, u.data());
    return u;
  }

  const DiscreteProblem<B>& problem_;
  const Discretization<B>& discretization_;
  const std::vector<double>& x_;
  std::vector<double> gradient_, before_;  // of functionals
  double size_ = 0;
};

// What holds the vertex pulls it off the obstacle.
template <int B>
void release(ContactNode<B>& node) {
  node.contact = false;
  node.pressure = 0;
  if constexpr (B > 1)
    if (node.law.coefficient > 0) {  // what does not press is not held back
      node.friction = false;
      node.dissipated = 0;
      node.tangential = {};
    }
  node.force = node.tangential;
}

/// Where it is friction.
template <int B>
std::optional<FrictionLaw> friction_law(const Model<B>& model, const Discretization<B>& discretization, Index slot) {
  const Constraints<B>& c = discretization.problem.constraints;
  const Friction* friction = model.obstacles[discretization.functional[slot]].obstacle->friction();
  if (!friction) return {};
  return friction->law(c.data.data() + Offset{slot} * c.width);
}

// Of a functional that is not friction: what is left of the vertex's force beside what its nodes have by their bounds.
template <int B>
void add_force(const NodeReader<B>& reader, Index slot, const ContactNode<B>* first, const ContactNode<B>* last,
               ContactNode<B>& node) {
  const std::array<double, B> force = reader.force_of_functional(slot);
  std::array<double, B> bounds{};
  if (!reader.has_facets(slot))
    for (; first != last && first->vertex == node.vertex; ++first)
      for (int i = 0; i < B && !first->held; ++i) bounds[i] += first->force[i];
  for (int i = 0; i < B; ++i) node.force[i] += force[i] - bounds[i];
}

// What functionals do, at their vertices' nodes; where there is none yet, one of its own.
template <int B>
void add_functionals(const NodeReader<B>& reader, const Model<B>& model, const Discretization<B>& discretization,
                     std::vector<ContactNode<B>>& nodes) {
  const auto known = nodes.size();
  const auto by_vertex = [](const auto& a, const auto& b) { return a.vertex < b.vertex; };
  for (std::size_t slot = 0; slot < discretization.functional.size(); ++slot) {
    const Index obstacle = discretization.functional[slot];
    if (obstacle < 0) continue;
    const Index p = discretization.problem.constraints.vector[slot];
    const auto here = static_cast<Index>(slot);
    auto at = static_cast<std::size_t>(std::partition_point(nodes.begin(), nodes.begin() + static_cast<Offset>(known),
                                                            [p](const auto& n) { return n.vertex < p; }) -
                                       nodes.begin());
    const std::size_t first = at;
    while (at < known && nodes[at].vertex == p && nodes[at].obstacle != obstacle) ++at;
    if (at == known || nodes[at].vertex != p) {
      at = nodes.size();
      nodes.push_back(reader.free_node(here));
    }
    if constexpr (B > 1)
      if (const auto law = friction_law(model, discretization, here)) {
        reader.add_friction(here, *law, nodes[at]);
        continue;
      }
    add_force(reader, here, nodes.data() + first, nodes.data() + known, nodes[at]);
  }
  std::inplace_merge(nodes.begin(), nodes.begin() + static_cast<Offset>(known), nodes.end(), by_vertex);
}

/// The nodes of one vertex and obstacle, one for each direction, are one vertex in contact.
template <int B>
struct ContactVertex {
  Index vertex = -1;
  bool contact = false, slips = false, sticks = false, undetermined = false;

  void add(const ContactNode<B>& node) {
    contact |= node.contact;
    slips |= node.friction && !node.sticks;
    sticks |= node.friction && node.sticks;
    undetermined |= node.contact && (node.held || node.shared);
  }
  void add_to(ContactSummary<B>& summary) const {
    if (!contact) return;
    ++summary.nodes;
    summary.slip_nodes += slips;
    summary.stick_nodes += sticks;
    summary.undetermined_nodes += undetermined;
  }
};

template <int B>
void add_forces(const ContactNode<B>& node, ContactSummary<B>& summary) {
  summary.dissipated += node.dissipated;
  for (int i = 0; i < B; ++i) {
    summary.force[i] += node.force[i];
    summary.tangential_force[i] += node.tangential[i];
  }
  if (!node.contact) return;
  summary.max_pressure = std::max(summary.max_pressure, node.recovered);
  if (node.held || node.shared) summary.undetermined_force += node.pressure * node.area;
}

/// Adds up the nodes of one obstacle, which come by ascending vertex.
template <int B>
class ContactTotals {
 public:
  explicit ContactTotals(ContactSummary<B>& summary) : summary_(summary) {}
  void add(const ContactNode<B>& node) {
    if (here_.vertex != node.vertex) {
      here_.add_to(summary_);
      here_ = {node.vertex};
    }
    here_.add(node);
    add_forces(node, summary_);
  }
  void finish() const { here_.add_to(summary_); }

 private:
  ContactSummary<B>& summary_;
  ContactVertex<B> here_;
};

/// How much of the slave's nodes of an obstacle the master is in front of; all of what it says nothing of.
template <int B>
class Covered {
 public:
  /// @param pairs null: no bodies touch each other
  Covered(const PairedBodies<B>* pairs, Index obstacle) {
    if (!pairs) return;
    const auto from = std::ranges::lower_bound(pairs->nodes, obstacle, {}, &PairedNode<B>::obstacle);
    nodes_ = {from, std::ranges::upper_bound(from, pairs->nodes.end(), obstacle, {}, &PairedNode<B>::obstacle)};
  }

  void tell(ContactNode<B>& node) const {
    const auto found = std::ranges::lower_bound(nodes_, node.vertex, {}, &PairedNode<B>::node);
    const bool known = found != nodes_.end() && found->node == node.vertex;
    node.covered = known ? found->covered : 1;
    node.taken = known ? found->taken : 0;
  }

 private:
  std::span<const PairedNode<B>> nodes_;
};

// Areas, pressures and what follows from them, for the nodes of one obstacle.
template <int D, int B>
void measure(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization, Index obstacle,
             double least_force, ContactState<B>& state) {
  const ContactSurface<D, B> surface(nodes, model, obstacle);
  ContactSummary<B>& summary = state.obstacles[obstacle];
  ContactTotals<B> totals(summary);
  const Covered<B> covered(discretization.pairs.get(), obstacle);
  const bool in_body = surface.in_body();
  for (ContactNode<B>& node : state.nodes) {
    if (node.obstacle != obstacle) continue;
    if constexpr (B > 1) covered.tell(node);
    node.area = (std::max(node.covered, node.least_covered) + node.taken) * surface.area(node);
    const double with_taken = node.covered > 0 ? 1 + node.taken / node.covered : 1;  // of what the pressure exerts
    node.recovered = node.pressure = node.area > 0 ? with_taken * node.pressure / node.area : 0;
    if constexpr (B > 1)
      for (int i = 0; i < B && node.area > 0; ++i) node.traction[i] = with_taken * node.tangential[i] / node.area;
  }
  if constexpr (B == 1) {
    const auto found = held_in_set(nodes, surface, obstacle, state.nodes, discretization.held);
    const auto known = state.nodes.insert(state.nodes.end(), found.begin(), found.end());
    std::inplace_merge(state.nodes.begin(), known, state.nodes.end(),
                       [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  }
  if (in_body) {
    if constexpr (B == 1) summary.area = coincidence_set(nodes, obstacle, state.nodes);
  } else {
    const RecoveredPressure recovered = recover_pressure(nodes, surface, obstacle, least_force, state.nodes);
    summary.area = recovered.area;
    summary.resolved = recovered.resolved;
    summary.peaks_at_edge = recovered.peaks_at_edge;
    summary.error = recovered.error;
  }
  for (const ContactNode<B>& node : state.nodes)
    if (node.obstacle == obstacle) totals.add(node);
  totals.finish();
}

/// What is held or shared and does not press is let go.
template <int B>
void release_what_does_not_press(const std::vector<double>& largest, std::vector<ContactNode<B>>& nodes) {
  for (ContactNode<B>& node : nodes) {
    const bool presses = node.pressure > positive_force * largest[node.obstacle];
    if (node.held && !presses) release(node);
    node.shared = node.shared && presses;
  }
}

}  // namespace

template <int D, int B>
ContactState<B> contact_state(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                              const std::vector<double>& x) {
  ContactState<B> state;
  state.obstacles.resize(model.obstacles.size());
  state.nodes.reserve(discretization.problem.constraints.vector.size());  // there may be one for every unknown
  const NodeReader<B> reader(discretization, x);
  for (Index slot = 0; slot < discretization.problem.constraints.size(); ++slot) {
    if (reader.has_facets(slot)) {
      const std::vector<ContactNode<B>> here = reader.read_polyhedron(slot);
      state.nodes.insert(state.nodes.end(), here.begin(), here.end());
      continue;
    }
    for (int k = 0; k < B; ++k)
      if (reader.bounded(slot, k)) state.nodes.push_back(reader.read(slot, k));
  }
  if (B > 1)  // of scalar ones see held_in_set()
    for (const HeldBound<B>& held : discretization.held) state.nodes.push_back(reader.read(held));
  if (!discretization.held.empty())
    std::stable_sort(state.nodes.begin(), state.nodes.end(),
                     [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  if (model.obstacles.size() > 1 || !discretization.held.empty())
    MeetingFaces<D, B>(nodes, model, discretization, to_global(discretization.problem, x), state.nodes).divide();
  if constexpr (D == B)
    if (discretization.pairs) BesideSlaves<D>(nodes, model, discretization, state.nodes).spread();
  add_functionals(reader, model, discretization, state.nodes);
  std::vector<double> largest(model.obstacles.size());
  for (const ContactNode<B>& node : state.nodes)
    largest[node.obstacle] = std::max(largest[node.obstacle], node.pressure);
  if (!discretization.held.empty() || !discretization.facets.empty()) release_what_does_not_press(largest, state.nodes);
  if constexpr (B > 1)
    for (ContactNode<B>& node : state.nodes) node.start = reader.start(node);
  for (std::size_t obstacle = 0; obstacle < model.obstacles.size(); ++obstacle)
    measure(nodes, model, discretization, static_cast<Index>(obstacle), positive_force * largest[obstacle], state);
  return state;
}

template ContactState<1> contact_state(const Nodes<2>&, const Model<1>&, const Discretization<1>&,
                                       const std::vector<double>&);
template ContactState<1> contact_state(const Nodes<3>&, const Model<1>&, const Discretization<1>&,
                                       const std::vector<double>&);
template ContactState<2> contact_state(const Nodes<2>&, const Model<2>&, const Discretization<2>&,
                                       const std::vector<double>&);
template ContactState<3> contact_state(const Nodes<3>&, const Model<3>&, const Discretization<3>&,
                                       const std::vector<double>&);

}  // namespace signorini
