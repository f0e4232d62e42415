#include "driver/warnings/contact_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/motions/mean_turn.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/pairs/tied_sides.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/chords.hpp"
#include "core/mesh/connected.hpp"
#include "core/mesh/rounding_of_places.hpp"
#include "driver/scene/numbers.hpp"

namespace signorini {
namespace {

static_assert(largest_turn == geometry::default_crease);

constexpr double deep = 0.1;         // of the body's extent along the obstacle's normal
constexpr double noticeable = 0.01;  // of the displacements
constexpr double coarse = 0.1;       // of these, between nodes
constexpr double edged =
    1e-4;  // of what contact flattens: chords up to a hundredth of its width; pressures peak between

double off(const ContactReport& contact) { return contact.off; }

std::string why_off(const ContactReport& contact) {
  if (contact.over_edge) return "there it moves over an edge of the obstacle, behind which conditions are others";
  return fmt::format("for these displacements the obstacle or the boundary is too curved, or {}",
                     contact.pair ? "the mesh too coarse: between bodies conditions are means over faces"
                                  : "quadratic elements are too coarse");
}

/// The same between nodes, if more than at these. (Of scalars it is what elements leave.)
double off_between(const ContactReport& contact) {
  const double by = contact.penetration_between_nodes;
  return contact.force.size() > 1 && by > contact.largest_penetration ? by / contact.largest_displacement : 0;
}

double beyond(const ContactReport& contact) { return noticeably_beyond(contact.beyond_nodes, contact.nodes); }

double undetermined(const ContactReport& contact) {
  double square = 0;
  for (const double f : contact.force) square += f * f;
  return square > 0 ? contact.undetermined_force / std::sqrt(square) : 0;
}

/// The step in which an obstacle has the largest of these; NaN is none.
template <class Value>
const StepReport& worst(const Report& report, std::size_t obstacle, Value value) {
  return *std::max_element(report.steps.begin(), report.steps.end(), [&](const StepReport& a, const StepReport& b) {
    return value(a.contact[obstacle]) < value(b.contact[obstacle]);
  });
}

std::string at_step(const Report& report, const StepReport& step) {
  return report.steps.size() > 1 ? fmt::format(", at t = {:g}", step.t) : "";
}

}  // namespace

template <int D, int B>
Warnings start_warnings(const Nodes<D>& nodes, const Model<B>& model, bool everywhere) {
  Warnings warnings;
  if constexpr (B == D)
    for (std::size_t k = 0; k < model.obstacles.size(); ++k) {
      const auto start = start_depth(nodes, model, static_cast<Index>(k), everywhere);
      // Away from the faces that may touch, a convex obstacle may well reach into the body.
      const bool deeply = start && !everywhere && start->depth > deep * start->extent;
      if (!start || !(start->completely || deeply)) continue;
      warnings.push_back(warning<"starts-inside">(model.obstacles[k].origin, start->completely ? "completely " : "",
                                                  start->depth, start->extent));
    }
  return warnings;
}

template <int D>
void refuse_pulling(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& contact,
                    const std::vector<double>& u) {
  if (!(max_norm(u) > rounding_of_places(nodes.mesh()))) return;
  for (std::size_t k = 0; k < model.obstacles.size(); ++k) {
    const ObstacleTerm<D>& term = model.obstacles[k];
    if (!term.shape) continue;
    const Surface<D> faces = term.on ? surface(nodes, select_faces(nodes.mesh(), *term.on, model.t)) : surface(nodes);
    const std::vector<Point<D>> normals = node_normals(nodes, faces);
    double pulls = 0, presses = 0;
    for (const ContactNode<D>& node : contact.nodes) {
      const auto at = std::ranges::lower_bound(faces.nodes, node.vertex);
      if (!node.contact || !std::cmp_equal(node.obstacle, k) || at == faces.nodes.end() || *at != node.vertex) continue;
      const double outwards = dot(node.force, node.direction) *
                              dot(node.direction, normals[static_cast<std::size_t>(at - faces.nodes.begin())]);
      (outwards > 0 ? pulls : presses) += std::abs(outwards);
    }
    if (pulls > presses)
      input_error(
          term.origin,
          fmt::format("the obstacle would pull at the faces on which it acts, by {:.3g}, and not press on them: "
                      "it lies on the wrong side of these; expected its normal the other way round (of a "
                      "surface file the triangles' orientation), or other faces",
                      pulls));
  }
}

template <int D, int B>
Warnings pair_warnings(const Nodes<D>& nodes, const Model<B>& model) {
  Warnings warnings;
  if constexpr (B == D)
    for (const ObstacleTerm<D>& term : model.obstacles) {
      if (!term.other) continue;
      const PairedFaces faces = paired_faces(nodes.mesh(), term, model.t);
      const MortarCoupling<D> coupling = couple_sides(nodes, model, term, faces.slave, faces.master);
      if (term.tied) {
        const WidestGap<D> gap = widest_gap(nodes, coupling, faces.slave);
        if (gap.width > gap.touching) warnings.push_back(warning<"tied-apart">(term.origin, gap.width));
        continue;
      }
      if (coupling.nodes() == 0) warnings.push_back(warning<"not-facing">(term.origin));
      const std::vector<FixedDirections<D>> fixes = collect_fixes<D, D>(nodes, model);
      const PrescribedNodes fixed = prescribed_nodes(nodes, fixes, faces.slave, coupling);
      Index lost = fixed.normal;
      if (term.obstacle->functional()) couple_whole_jumps<D>(nodes, model, term, faces, fixes, {}, {}, &lost);
      if (lost > 0 && fixed.normal > 0 && fixed.normal < fixed.all)
        warnings.push_back(warning<"prescribed-slave">(term.origin, fixed.normal, fixed.all,
                                                       "normal: nothing keeps the other body off them"));
      if (term.obstacle->friction() && std::min(lost, fixed.some) > fixed.normal)
        warnings.push_back(warning<"prescribed-slave">(term.origin, std::min(lost, fixed.some), fixed.all,
                                                       "surface: no friction acts there along what is prescribed"));
    }
  return warnings;
}

template <int D, int B>
Warnings apart_warnings(const Scene& scene, std::size_t body, const Report& report, const Results<D, B>& results) {
  Warnings warnings;
  if (!report.converged()) return warnings;
  const std::vector<int> numbers = numbers_of(scene.obstacles, scene.bodies[body]);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto touches = [&](const StepReport& step) {  // or acts from afar, as springs do
      const ContactReport& contact = step.contact[numbers[k]];
      return contact.nodes > 0 || std::ranges::any_of(contact.force, [](double f) { return f != 0; });
    };
    if (std::ranges::any_of(report.steps, touches)) continue;
    const Scene::Obstacle& obstacle = scene.obstacles[numbers[k]];
    const bool paired = !obstacle.other.empty();
    double least = infinity;  // where nothing is in front of anything
    for (const ContactNode<B>& node : paired ? results.masters : results.contact.nodes)
      if (std::cmp_equal(node.obstacle, k)) least = std::min(least, node.gap);
    if (!std::isfinite(least)) continue;
    warnings.push_back(warning<"never-touch">(
        obstacle.source.table, obstacle.body,
        paired ? fmt::format("and '{}'", obstacle.other) : std::string("and the obstacle"),
        least < 0 ? fmt::format("they overlap by {:.3g}, in the mean around a node, and no condition keeps them apart "
                                "there: expected smaller elements, or the other side as the slave",
                                -least)
                  : fmt::format("a distance of {:.3g} is left between them", least)));
  }
  return warnings;
}

Warnings contact_warnings(const Scene& scene, const Report& report) {
  Warnings warnings;
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const std::string& origin = scene.obstacles[k].source.table;
    const StepReport& farthest = worst(report, k, off);
    const ContactReport& contact = farthest.contact[k];
    if (off(contact) > 1)
      warnings.push_back(warning<"too-curved">(
          origin, std::fmax(contact.largest_penetration, contact.largest_opening),
          contact.largest_penetration >= contact.largest_opening ? "inside the obstacle"
                                                                 : "off the obstacle at nodes that count as in contact",
          contact.depth > 0 ? fmt::format("contact flattens it by {:.3g} and ", contact.depth) : "",
          contact.largest_displacement, at_step(report, farthest), why_off(contact)));
    const StepReport& between = worst(report, k, off_between);
    if (const ContactReport& c = between.contact[k]; off_between(c) > coarse)
      warnings.push_back(warning<"between-nodes">(
          origin, c.penetration_between_nodes,
          c.largest_displacement > 0 ? fmt::format("where displacements are up to {:.3g}", c.largest_displacement)
                                     : "which no node touches",
          at_step(report, between)));
    if (const ContactReport& c = report.steps.back().contact[k]; !c.resolved)
      warnings.push_back(
          warning<"unresolved-contact">(origin, c.nodes == 1 ? "1 node" : fmt::format("{} nodes", c.nodes)));
    else if (c.peaks_at_edge)
      warnings.push_back(warning<"peak-at-edge">(origin));
    const StepReport& past = worst(report, k, beyond);
    if (const ContactReport& c = past.contact[k]; beyond(c) > 1)
      warnings.push_back(warning<"slid-past">(origin, c.beyond_nodes, c.nodes, at_step(report, past)));
    const StepReport& held = worst(report, k, undetermined);
    if (const ContactReport& c = held.contact[k]; c.undetermined_nodes > 0)
      warnings.push_back(warning<"undetermined-force">(origin, c.undetermined_nodes, c.nodes, at_step(report, held),
                                                       c.undetermined_force));
  }
  return warnings;
}

namespace {

template <int D, int B>
double along_normal(const Results<D, B>& results, const ContactNode<B>& node) {
  double along = 0;
  for (int i = 0; i < B; ++i) along += node.direction[i] * results.u[Offset{node.vertex} * B + i];
  return along;
}

/// Each body turns as a whole.
template <int D>
std::vector<MeanTurn> turns(const Model<D>& model, const Nodes<D>& nodes, const std::vector<double>& u) {
  if (model.plane == Plane::axisymmetric) return {{}};
  return mean_turns(nodes, is_paired(model) ? connected_parts(nodes.mesh()) : std::vector<Index>(), u);
}

/// The largest motion of vertices in contact along the obstacles' normals; 0 where that is rounding.
template <int D>
double pressed_in(const Mesh<D>& mesh, const Results<D, D>& results) {
  double most = 0;
  for (const ContactNode<D>& node : results.contact.nodes)
    if (node.contact) most = std::max(most, std::fabs(along_normal(results, node)));
  return most > rounding_of_places(mesh) ? most : 0;
}

template <int D>
const char* what_turns(const Model<D>& model) {
  return is_paired(model) ? "one of the bodies" : "the body";
}

}  // namespace

template <int D>
void refuse_turned(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u) {
  constexpr double nonsense = std::numbers::pi;
  const double turn = std::ranges::max(turns(model, nodes, u), {}, &MeanTurn::angle).angle;
  if (model.obstacles.empty() || !(turn > nonsense)) return;
  input_error(
      model.origin,
      fmt::format("{} would turn by {:.2g} degrees: linear elasticity, which is meant for small turns, says "
                  "nothing of that; expected a fix that holds it, as where nothing but contact without friction "
                  "keeps a round body from turning, or smaller loads",
                  what_turns(model), turn * 180 / std::numbers::pi));
}

template <int D>
Warnings turn_warnings(const Model<D>& model, const Nodes<D>& nodes, const Results<D, D>& results) {
  constexpr double noticeable_turn = 0.1;
  const std::vector<MeanTurn> all = turns(model, nodes, results.u);
  const MeanTurn turn = std::ranges::max(all, {}, &MeanTurn::off_circle);
  const double most = std::ranges::max(all, {}, &MeanTurn::angle).angle, pressed = pressed_in(nodes.mesh(), results);
  if (!(most > noticeable_turn || (pressed > 0 && turn.off_circle() > noticeable * pressed))) return {};
  return {warning<"large-turn">(
      model.origin, what_turns(model), turn.angle * 180 / std::numbers::pi, 0.5 * turn.angle * turn.angle,
      pressed > 0 ? fmt::format(", and moves points outwards by up to {:.2g}, where contact moves along its normals by "
                                "up to {:.2g}",
                                turn.off_circle(), pressed)
                  : "")};
}

template void refuse_turned(const Nodes<2>&, const Model<2>&, const std::vector<double>&);
template void refuse_turned(const Nodes<3>&, const Model<3>&, const std::vector<double>&);
template void refuse_pulling(const Nodes<2>&, const Model<2>&, const ContactState<2>&, const std::vector<double>&);
template void refuse_pulling(const Nodes<3>&, const Model<3>&, const ContactState<3>&, const std::vector<double>&);
template Warnings turn_warnings(const Model<2>&, const Nodes<2>&, const Results<2, 2>&);
template Warnings turn_warnings(const Model<3>&, const Nodes<3>&, const Results<3, 3>&);

template <int D, int B>
Warnings chord_warnings(const Model<B>& model, const MeshHierarchy<D>& hierarchy, const Nodes<D>& nodes,
                        const Results<D, B>& results) {
  Warnings warnings;
  for (std::size_t k = 0; k < results.deformed.size() && B == D; ++k) {
    const bool refined = !hierarchy.refinements.empty();
    // Vertices are on what faces stand for: a rigid obstacle, whose distance is that of nodes, is where it should be.
    if (!results.deformed[k] || !(refined || model.obstacles[k].other)) continue;
    const double depth = results.deformed[k]->depth, displacement = results.deformed[k]->displacement;
    // Pressures peak where refinement has brought out the edges; before that the gap alone is wrong.
    const double most = depth > 0 && refined ? edged * depth : noticeable * std::max(depth, displacement);
    const auto add = [&](const char* whose, double sagitta, double angle) {
      if (!(sagitta > most)) return;
      warnings.push_back(
          warning<"flat-faces">(model.obstacles[k].origin, whose, sagitta,
                                depth > 0 ? fmt::format("contact flattens it by {:.3g} and ", depth) : "", displacement,
                                100 * sagitta / (depth > 0 ? depth : displacement), whose,
                                angle > geometry::default_crease
                                    ? fmt::format(", with a crease of more than the {:.0f} degrees between them,",
                                                  angle * 180 / std::numbers::pi)
                                    : ""));
    };
    const auto add_smoothed = [&](const char* whose, const SmoothedOver& over) {
      if (!(over.error() > noticeable * (depth > 0 ? depth : displacement))) return;
      warnings.push_back(warning<"smoothed-edges">(
          model.obstacles[k].origin, whose, over.angle * 180 / std::numbers::pi, over.by,
          depth > 0 ? fmt::format("contact flattens it by {:.3g} and ", depth) : "", displacement));
    };
    std::vector<bool> touching(nodes.size()), at_vertex;
    for (const auto* side : {&results.contact.nodes, &results.masters})
      for (const ContactNode<B>& node : *side)
        if (node.contact && node.obstacle == static_cast<Index>(k)) touching[node.vertex] = true;
    for (Index v = 0; v < nodes.mesh().vertices(); ++v) at_vertex.push_back(touching[nodes.of_vertex(v)]);
    const bool by_shape = D == 2 && hierarchy.levels.front().pieces.empty();  // a polygon's edges are straight
    const Chords chords = by_shape ? Chords{} : chord_sagitta(hierarchy, std::move(at_vertex));
    add("body", chords.sagitta, chords.angle);
    add("obstacle", results.deformed[k]->sagitta, 0);
    add_smoothed("body", chords.smoothed);
    add_smoothed("obstacle", results.deformed[k]->smoothed);
  }
  return warnings;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                 \
  template Warnings start_warnings(const Nodes<D>&, const Model<B>&, bool);                         \
  template Warnings pair_warnings(const Nodes<D>&, const Model<B>&);                                \
  template Warnings apart_warnings(const Scene&, std::size_t, const Report&, const Results<D, B>&); \
  template Warnings chord_warnings(const Model<B>&, const MeshHierarchy<D>&, const Nodes<D>&, const Results<D, B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
