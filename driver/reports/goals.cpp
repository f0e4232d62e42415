#include "driver/reports/goals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

template <int B>
using Direction = std::array<double, B>;

/// Writes what holds the nodes in contact, and what a goal asks of the forces there.
template <int B>
class HeldNodes {
 public:
  HeldNodes(const Discretization<B>& discretization, Quantity<B>& goal) : discretization_(discretization), goal_(goal) {
    const std::size_t vectors = discretization.problem.fixed.size();
    goal.of_solution.assign(vectors * B, 0.0);
    goal.of_force.assign(vectors * B, 0.0);
    goal.held.assign(vectors, 0);
  }

  void hold(const ContactNode<B>& node) {
    const Index slot = constraints().slot[node.vertex];
    if (slot < 0) return;
    goal_.held[node.vertex] |= normal(node, slot);
    if (node.friction && node.sticks) goal_.held[node.vertex] |= constraints().tangential[slot];
  }

  /// The goal asks for the part of the force that presses along this direction.
  void ask(const ContactNode<B>& node, const Direction<B>& along) {
    const Index slot = constraints().slot[node.vertex];
    if (slot < 0) return;
    const Flags pressed = normal(node, slot);
    const double* N = discretization_.problem.frames.dual_at(node.vertex);
    for (int k = 0; k < B; ++k) {
      if (!(pressed >> k & 1u)) continue;
      double& weight = goal_.of_force[Offset{node.vertex} * B + k] = 0;
      for (int i = 0; i < B; ++i) weight += along[i] * measured(N, i, k);
    }
  }

 private:
  const Constraints<B>& constraints() const { return discretization_.problem.constraints; }
  static double measured(const double* N, int i, int k) { return N ? N[i * B + k] : i == k ? 1 : 0; }

  /// The components in which its obstacle holds a node: where faces do, all of them.
  Flags normal(const ContactNode<B>& node, Index slot) const {
    if (constraints().has_facets(slot)) return static_cast<Flags>((1u << B) - 1);
    const double* N = discretization_.problem.frames.dual_at(node.vertex);
    double largest = 0;
    Flags out = 0;
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k;
      if (discretization_.lower_obstacle[at] != node.obstacle && discretization_.upper_obstacle[at] != node.obstacle)
        continue;
      double along = 0;
      for (int i = 0; i < B; ++i) along += node.direction[i] * measured(N, i, k);
      if (!(std::abs(along) > largest)) continue;
      largest = std::abs(along);
      out = static_cast<Flags>(1u << k);
    }
    return out;
  }

  const Discretization<B>& discretization_;
  Quantity<B>& goal_;
};

template <int B>
bool is_in_contact(const ContactNode<B>& node) {
  return node.contact && !node.held;
}

/// The largest normal force of an obstacle: what presses at its nodes, along it.
template <int D, int B>
void ask_for_force(const Nodes<D>& nodes, const Results<D, B>& results, const StepReport& report, HeldNodes<B>& held,
                   Quantity<B>& goal) {
  std::vector<double> size;
  for (const ContactReport& contact : report.contact)
    size.push_back(std::sqrt(dot(contact.normal_force, contact.normal_force)));
  const auto obstacle = static_cast<Index>(std::ranges::max_element(size) - size.begin());
  goal.value = size[obstacle];
  Direction<B> along{};
  for (const ContactNode<B>& node : results.contact.nodes)
    for (int i = 0; i < B && node.obstacle == obstacle && node.contact; ++i)
      along[i] += node.force[i] - node.tangential[i];
  const Whole whole(nodes.mesh().mirrors, results.across.obstacles[obstacle]);
  along = whole.total(along);
  normalise(along);
  for (double& d : along) d *= whole.copies();
  for (const ContactNode<B>& node : results.contact.nodes)
    if (node.obstacle == obstacle && is_in_contact(node)) held.ask(node, along);
}

/// Of neighbours, around the largest pressure. The mean over one of them has errors that the recovery of pressures
/// smoothes away; that over all of the recovery's rings has lost some which that has.
constexpr int rings_of_mean = 2;

/// Nodes of an obstacle's contact within these rings.
template <int D, int B>
std::vector<const ContactNode<B>*> pressed_around(const Nodes<D>& nodes, const std::vector<ContactNode<B>>& all,
                                                  const ContactNode<B>& top) {
  std::vector<const ContactNode<B>*> pressed(static_cast<std::size_t>(nodes.size()));
  for (const ContactNode<B>& node : all)
    if (node.obstacle == top.obstacle && is_in_contact(node)) pressed[node.vertex] = &node;
  std::vector<char> reached(pressed.size());
  reached[top.vertex] = true;
  for (int ring = 0; ring < rings_of_mean; ++ring) {
    const std::vector<char> before = reached;
    for (std::size_t e = 0; e < nodes.mesh().elements.size(); ++e) {
      const auto corners = nodes.of_simplex(e);
      if (std::ranges::none_of(corners, [&](Index p) { return before[p] != 0; })) continue;
      for (const Index p : corners) reached[p] = pressed[p] != nullptr;
    }
  }
  std::vector<const ContactNode<B>*> out;
  for (std::size_t p = 0; p < pressed.size(); ++p)
    if (reached[p] != 0) out.push_back(pressed[p]);
  return out;
}

/// The largest pressure, by the mean around the node that has it.
template <int D, int B>
void ask_for_pressure(const Nodes<D>& nodes, const Results<D, B>& results, HeldNodes<B>& held, Quantity<B>& goal) {
  const auto& all = results.contact.nodes;
  const auto recovered = [](const ContactNode<B>& node) { return is_in_contact(node) ? node.recovered : 0; };
  const auto top = std::ranges::max_element(all, {}, recovered);
  if (top == all.end() || !is_in_contact(*top)) return;
  goal.value = top->recovered;
  const auto patch = pressed_around(nodes, all, *top);
  double area = 0;
  for (const ContactNode<B>* node : patch) area += node->area * node->covered;
  for (const ContactNode<B>* node : patch) {
    Direction<B> along = node->direction;
    for (double& d : along) d /= area;
    held.ask(*node, along);
  }
}

/// How far a probe moves, or its value.
template <int D, int B>
void ask_for_probe(const Nodes<D>& nodes, const Place<D>& place, const Discretization<B>& discretization,
                   const Results<D, B>& results, Quantity<B>& goal) {
  Direction<B> along = evaluate<B>(nodes, place, results.u);
  goal.value = normalise(along);
  const Place<D> at = in_element(nodes, place);
  std::vector<double> forces(goal.of_solution.size());
  with_order(nodes, [&](auto order) {
    const auto node = nodes.of(nodes.template elements<order>()[at.element]);
    const auto value = basis<order>(at.barycentric);
    for (std::size_t a = 0; a < node.size(); ++a)
      for (int i = 0; i < B; ++i) forces[Offset{node[a]} * B + i] += value[a] * along[i];
  });
  goal.of_solution = local_forces(discretization.problem, std::move(forces));
}

}  // namespace

template <int D, int B>
void check_goal(const Scene& scene, std::size_t body, const Model<B>& model, bool own_pressure) {
  const auto fail = [&](const std::string& what) {
    input_error(scene.refine.source.of("goal"), fmt::format("{}; expected \"energy\"", what));
  };
  const Scene::Body& own = scene.bodies[body];
  if (own_pressure)
    fail(fmt::format("body '{}' is nearly incompressible, and its pressures have unknowns of their own", own.name));
  if (scene.solver.bodies == "dirichlet-neumann") fail("bodies are solved in turns");
  for (const ObstacleTerm<B>& term : model.obstacles)
    if (term.obstacle->functional() && !term.obstacle->friction())
      fail(fmt::format("what {} adds to the energy is no friction", term.origin));
}

template <int D, int B>
Quantity<B> goal_of(const Scene& scene, const Nodes<D>& nodes, const Probes<D>& probes,
                    const Discretization<B>& discretization, const Results<D, B>& results, const StepReport& report) {
  Quantity<B> goal;
  HeldNodes<B> held(discretization, goal);
  for (const ContactNode<B>& node : results.contact.nodes)
    if (is_in_contact(node)) held.hold(node);
  if (scene.refine.goal == "force") {
    ask_for_force(nodes, results, report, held, goal);
  } else if (scene.refine.goal == "peak_pressure") {
    ask_for_pressure(nodes, results, held, goal);
  } else {
    const auto number = std::ranges::find(probes.names, scene.refine.goal_probe()) - probes.names.begin();
    ask_for_probe(nodes, probes.places[number], discretization, results, goal);
  }
  return goal;
}

std::string error_text(const GoalReport& goal) {
  if (!std::isfinite(goal.relative_error())) return fmt::format("{} {:.6g}, error not known", goal.name, goal.value);
  return fmt::format("{} {:.6g}, error estimated as {:.2g} %", goal.name, goal.value, 100 * goal.relative_error());
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                       \
  template void check_goal<D, B>(const Scene&, std::size_t, const Model<B>&, bool);                       \
  template Quantity<B> goal_of(const Scene&, const Nodes<D>&, const Probes<D>&, const Discretization<B>&, \
                               const Results<D, B>&, const StepReport&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
