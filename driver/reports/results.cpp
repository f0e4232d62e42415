#include "driver/reports/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/rounding.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/fem/recovery/better_side.hpp"
#include "core/fem/recovery/between_nodes.hpp"
#include "core/fem/recovery/cut_faces.hpp"
#include "core/fem/recovery/ties.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/mirror.hpp"
#include "driver/reports/contact_report.hpp"
#include "driver/reports/moments.hpp"
#include "driver/scene/materials.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/part_nodes.hpp"

namespace signorini {

namespace {

/// The moment of forces at nodes about the origin; nothing for scalars, and bodies of revolution.
template <int D, int B>
class MomentOfForces {
 public:
  MomentOfForces(const Nodes<D>& nodes, const Model<B>& model, Planes across, std::vector<double>& sum)
      : nodes_(nodes), across_(across), sum_(sum) {
    if (B == D && model.plane != Plane::axisymmetric) sum.resize(moment_entries<D>);
  }
  void add(Index node, const std::array<double, B>& force) {
    if constexpr (B == D)
      if (!sum_.empty())
        add_moment<D>(nodes_.mesh().mirrors, across_, nodes_.control_point(node), force, std::vector<double>(D), sum_);
  }

 private:
  const Nodes<D>& nodes_;
  const Planes across_;
  std::vector<double>& sum_;
};

template <int D, int B>
void add_spring_forces(const Nodes<D>& nodes, const Model<B>& model, Results<D, B>& out) {
  out.spring_moments.resize(model.springs.size());
  for (std::size_t k = 0; k < model.springs.size(); ++k) {
    std::vector<double> forces(out.u.size());
    add_spring_forces(nodes, model, model.springs[k], out.u, forces);
    std::array<double, B>& total = out.forces.springs.emplace_back();
    MomentOfForces<D, B> moment(nodes, model, out.across.springs[k], out.spring_moments[k]);
    for (Index p = 0; p < nodes.size(); ++p) {
      std::array<double, B> force;
      std::copy_n(forces.data() + Offset{p} * B, B, force.begin());
      for (int i = 0; i < B; ++i) total[i] += force[i];
      moment.add(p, force);
    }
  }
}

template <int D, int B>
void add_moments_of_fixes(const Nodes<D>& nodes, const Model<B>& model, Results<D, B>& out) {
  out.moments.resize(model.fixes.size());
  std::vector<MomentOfForces<D, B>> moments;
  moments.reserve(out.moments.size());
  for (std::size_t k = 0; k < out.moments.size(); ++k)
    moments.emplace_back(nodes, model, out.across.fixes[k], out.moments[k]);
  for (const auto& [node, fix, force] : out.forces.at_fixes) moments[fix].add(node, force);
}

}  // namespace

template <int D, int B>
Results<D, B> results(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                      std::vector<double> x, std::vector<double> pressure, std::vector<SlaveChoice> slaves,
                      std::vector<Point<B>> shift, JointLoad<B> joints) {
  const bool global = discretization.problem.frames.slot.empty() && !discretization.problem.jumps;
  Results<D, B> out;
  out.u = to_global(discretization.problem, global ? std::exchange(x, {}) : x);
  const std::vector<double>& local = global ? out.u : x;
  out.contact = contact_state(nodes, model, discretization, local);
  out.pressure = std::exchange(pressure, {});
  out.rigid = rigid_motions(model, discretization, local);
  out.slaves = std::exchange(slaves, {});
  out.shift = std::move(shift);
  out.across = conditions_across(nodes, model);
  out.slaves.resize(model.obstacles.size());
  out.ties = tie_forces(nodes, model, discretization, local);
  out.bolts = bolts<D>(model, discretization, out.ties, local);
  out.counterforces = counterforces(nodes, model, discretization.problem, out.contact, out.ties);
  MasterSide<B> masters = master_side(nodes, model, out.counterforces, out.u);
  if constexpr (D == B)
    if (discretization.pairs) take_better_side(model, *discretization.pairs, masters, out.contact);
  out.masters = std::move(masters.nodes);
  sum_up(out.ties, out.contact.obstacles);
  const auto back = totals(out.counterforces, model.obstacles.size(), true);
  const auto along = totals(out.counterforces, model.obstacles.size(), true, &NodalForce<B>::tangential);
  for (std::size_t k = 0; k < back.size(); ++k)
    for (int i = 0; i < B; ++i) {
      out.contact.obstacles[k].force[i] += back[k][i];
      out.contact.obstacles[k].tangential_force[i] += along[k][i];
    }
  out.forces = forces(model, discretization, out.contact, local);
  add_spring_forces(nodes, model, out);
  add_moments_of_fixes(nodes, model, out);
  out.joints = std::move(joints);
  for (std::size_t k = 0; k < out.joints.total.size(); ++k)
    for (int i = 0; i < B; ++i) out.forces.applied[k][i] += out.joints.total[k][i];
  out.deformed = deformed_contacts(nodes, model, out.contact, out.u);
  for (Index k = 0; k < std::ssize(model.obstacles); ++k)
    out.between_nodes.push_back(model.obstacles[k].tied ? std::numeric_limits<double>::quiet_NaN()
                                                        : violation_between_nodes(nodes, model, k, out.contact, out.u));
  return out;
}

namespace {

/// Replaces a point by its image on the side of each plane of symmetry that is meshed.
template <int D>
Planes move_to_part(const Mesh<D>& mesh, Point<D>& x) {
  Planes beyond = 0;
  for (std::size_t m = 0; m < mesh.mirrors.size(); ++m) {
    const Mirror& mirror = mesh.mirrors[m];
    const auto side = [&](const Point<D>& p) { return p[mirror.axis] - mirror.at; };
    const bool above = std::ranges::any_of(mesh.points, [&](const Point<D>& p) { return side(p) > 0; });
    if (!(above ? side(x) < 0 : side(x) > 0)) continue;
    x = reflected<D>(mirror, x);
    beyond |= 1u << m;
  }
  return beyond;
}

}  // namespace

template <int D>
Probes<D> locate_probes(const Mesh<D>& mesh, const Scene& scene, std::size_t body) {
  Probes<D> probes;
  for (const int number : numbers_of(scene.probes, scene.bodies[body])) {
    const Scene::Probe& probe = scene.probes[number];
    Point<D> at;
    std::copy_n(probe.at.begin(), D, at.begin());
    probes.beyond.push_back(move_to_part<D>(mesh, at));
    probes.names.push_back(probe.name);
    probes.places.push_back(locate<D>(mesh, at, probe.source.of("at")));
  }
  return probes;
}

namespace {

/// Of the whole of what each condition stands for.
template <int B>
std::vector<ForceReport> force_reports(const std::vector<int>& numbers,
                                       const std::vector<std::array<double, B>>& forces,
                                       const std::vector<Mirror>& mirrors, const std::vector<Planes>& across,
                                       const std::vector<std::vector<double>>& moments = {}) {
  std::vector<ForceReport> reports;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const auto whole = Whole(mirrors, across[k]).total(forces[k]);
    reports.push_back({numbers[k], {whole.begin(), whole.end()}, moments.empty() ? std::vector<double>() : moments[k]});
  }
  return reports;
}

template <int B>
std::vector<RigidReport> rigid_reports(const std::vector<int>& numbers, const std::vector<RigidMotion<B>>& motions) {
  std::vector<RigidReport> reports;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const RigidMotion<B>& motion = motions[k];
    const auto list = [](const auto& array) { return std::vector<double>(array.begin(), array.end()); };
    RigidReport& report =
        reports.emplace_back(RigidReport{numbers[k], list(motion.point), list(motion.displacement),
                                         list(motion.rotation), list(motion.applied), list(motion.torque)});
    for (int i = 0; i < B; ++i) report.force[i] += motion.reaction[i];
  }
  return reports;
}

/// Adds the forces of the tables that belong to a body; numbers[k] is the table of forces[k].
template <int B, class Table>
void add_forces(const std::vector<std::array<double, B>>& forces, const std::vector<int>& numbers,
                const std::vector<Table>& tables, std::string Table::*of, const std::string& body,
                std::vector<double>& total) {
  total.resize(B);
  for (std::size_t k = 0; k < forces.size(); ++k)
    for (int i = 0; i < B; ++i)
      if (tables[numbers[k]].*of == body) total[i] += forces[k][i];
}

/// What pressure in joints exerts on the part of another load's body: what it exerts there beside its own faces.
template <int D, int B>
void add_in_joints(const Scene& scene, const Scene::Body& body, std::size_t part, const Nodes<D>& nodes,
                   const Results<D, B>& results, std::vector<double>& total) {
  const std::vector<double>& force = results.joints.force;
  if (force.empty()) return;
  const std::vector<char> inside = nodes_of_part(scene, body, part, nodes);
  for (std::size_t p = 0; p < inside.size(); ++p)
    for (std::size_t i = 0; i < B && inside[p]; ++i) total[i] += force[p * B + i];
  const std::vector<int> loads = numbers_of(scene.loads, body);
  for (std::size_t k = 0; k < loads.size(); ++k)  // counted there already
    for (std::size_t i = 0; i < B && scene.loads[loads[k]].body == (body.parts.empty() ? body : body.parts[part]).name;
         ++i)
      total[i] -= results.joints.total[k][i];
}

/// Of a body, or of its parts: what touches one of them pushes the other one back.
template <int D, int B>
std::vector<BalanceReport> balances(const Scene& scene, const Scene::Body& body, const Nodes<D>& nodes,
                                    const Results<D, B>& results, const Whole& whole) {
  const Forces<B>& forces = results.forces;
  const ContactForces<B> contact = contact_forces(results);
  std::vector<std::string> names{body.name};
  if (!body.parts.empty()) names.clear();
  for (const Scene::Body& part : body.parts) names.push_back(part.name);
  const std::vector<int> obstacles = numbers_of(scene.obstacles, body);
  std::vector<BalanceReport> out;
  for (const std::string& name : names) {
    BalanceReport& balance = out.emplace_back(BalanceReport{name, {}, {}, {}});
    add_forces<B>(forces.applied, numbers_of(scene.loads, body), scene.loads, &Scene::Load::body, name,
                  balance.applied);
    add_in_joints(scene, body, out.size() - 1, nodes, results, balance.applied);
    add_forces<B>(forces.reactions, numbers_of(scene.fixes, body), scene.fixes, &Scene::Fix::body, name,
                  balance.reactions);
    add_forces<B>(forces.springs, numbers_of(scene.springs, body), scene.springs, &Scene::Spring::body, name,
                  balance.reactions);
    const std::vector<int> rigids = numbers_of(scene.rigids, body);
    for (std::size_t k = 0; k < results.rigid.size(); ++k)
      for (int i = 0; i < B && scene.rigids[rigids[k]].body == name; ++i) {
        balance.applied[i] += results.rigid[k].applied[i];
        balance.reactions[i] += results.rigid[k].reaction[i];
      }
    add_forces<B>(contact.on_body, obstacles, scene.obstacles, &Scene::Obstacle::body, name, balance.contact);
    add_forces<B>(contact.on_other, obstacles, scene.obstacles, &Scene::Obstacle::other, name, balance.contact);
    for (std::vector<double>* sum : {&balance.applied, &balance.reactions, &balance.contact}) *sum = whole.total(*sum);
  }
  return out;
}

Summary of_whole(Summary summary, const Whole& whole) {
  summary.energy *= whole.copies();
  for (IterationRecord& record : summary.history) record.energy *= whole.copies();
  return summary;
}

std::vector<std::string> plane_names(const std::vector<Mirror>& mirrors) {
  std::vector<std::string> names;
  names.reserve(mirrors.size());
  for (const Mirror& mirror : mirrors) names.push_back(plane_name(mirror));
  return names;
}

template <int D>
Index on_axis(const Nodes<D>& nodes) {
  Index count = 0;
  for (Index p = 0; p < nodes.size(); ++p) count += nodes.at(p)[0] == 0;
  return count;
}

}  // namespace

template <int D, int B>
StepReport step_report(const Scene& scene, const Nodes<D>& nodes, const Probes<D>& probes, const Results<D, B>& results,
                       double t, const Summary& summary, std::size_t number) {
  const Scene::Body& body = scene.bodies[number];
  const std::vector<Mirror>& mirrors = nodes.mesh().mirrors;
  const Whole whole(mirrors, all_planes(nodes.mesh()));
  StepReport report;
  report.t = t;
  report.summary = of_whole(summary, whole);
  const Forces<B>& forces = results.forces;
  report.applied = force_reports<B>(numbers_of(scene.loads, body), forces.applied, mirrors, results.across.loads);
  for (std::size_t k = 0; k < report.applied.size(); ++k)
    if (ForceReport& load = report.applied[k]; scene.loads[load.number].where_open && !results.joints.area.empty())
      load.open_area = results.joints.area[k] * Whole(mirrors, results.across.loads[k]).copies();
  report.reactions =
      force_reports<B>(numbers_of(scene.fixes, body), forces.reactions, mirrors, results.across.fixes, results.moments);
  report.springs = force_reports<B>(numbers_of(scene.springs, body), forces.springs, mirrors, results.across.springs,
                                    results.spring_moments);
  report.rigid = rigid_reports(numbers_of(scene.rigids, body), results.rigid);
  const bool axisymmetric = body.plane == Plane::axisymmetric;
  report.bodies = {{body.name, report.summary, axisymmetric, axisymmetric && B == D ? on_axis(nodes) : 0,
                    plane_names(mirrors), whole.copies(), body.order, body.order_chosen}};
  report.balance = balances(scene, body, nodes, results, whole);
  report.contact = contact_reports(scene, nodes, results, t, number);
  for (std::size_t k = 0; k < probes.names.size(); ++k) {
    const auto value = evaluate<B>(nodes, probes.places[k], results.u);
    const auto probe = std::ranges::find(scene.probes, probes.names[k], &Scene::Probe::name);
    report.probes.push_back({probes.names[k], probe->body, {value.begin(), value.end()}});
    for (std::size_t m = 0; m < mirrors.size() && B == D; ++m)
      if (probes.beyond[k] >> m & 1u) report.probes.back().value[mirrors[m].axis] *= -1;
  }
  return report;
}

namespace {

// Poisson's ratio: there a ball on a plane has its largest pressure 7 % off with linear elements, as the warning says.
constexpr double too_incompressible = 0.45;

/// Of bodies without pressures of their own, whatever the scene says.
Warnings orthotropic_locking(const Scene::Body& body) {
  Warnings warnings;
  for (const Scene::Body& part : body.parts) std::ranges::move(orthotropic_locking(part), std::back_inserter(warnings));
  if (!body.orthotropic) return warnings;
  const double poisson = mean_constants(body.orthotropic->constants).poisson;
  if (poisson < too_incompressible) return warnings;
  warnings.push_back(
      warning<"locking">(poisson, "elements are too stiff for",
                         fmt::format("which orthotropic body '{}' is in the mean of all directions: pressures as "
                                     "unknowns of their own are for isotropic bodies",
                                     body.name)));
  return warnings;
}

}  // namespace

template <int D>
Warnings scene_warnings(const Scene& scene, const Mesh<D>& mesh, std::size_t number) {
  const Scene::Body& body = scene.bodies[number];
  if (body.equation != Scene::Equation::elasticity || (D == 2 && body.plane == Plane::stress)) return {};
  const Field ratio = coefficient(scene, body, &Scene::Body::poisson, &Scene::Material::poisson);
  double poisson = ratio.constant().value_or(0);
  if (!ratio.constant())
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) poisson = std::max(poisson, ratio(site_in(mesh, e, 1)));
  Warnings warnings = orthotropic_locking(body);
  if (poisson < too_incompressible || (body.order == 2 && body.pressure != Pressure::none)) return warnings;
  if (body.order == 2)
    warnings.push_back(
        warning<"locking">(poisson, "quadratic elements of displacements alone lose accuracy in",
                           "pressures most of all (docs/rubber.md); pressure = \"linear\", the default, does not"));
  else
    warnings.push_back(warning<"locking">(
        poisson, "linear elements are too stiff for",
        fmt::format(
            "and refinement helps slowly: the largest pressure of a ball on a plane is 7 % off at 0.45, 43 % at "
            "0.49, and 290 % at 0.499, about 0.8 % for each unit of lambda / mu, here {:.3g}; order = 2 does not "
            "lock",
            2 * poisson / (1 - 2 * poisson))));
  return warnings;
}

namespace {

/// @param alike further places with this expression
Warning cut_warning(const CutSelection& cut, const std::vector<std::string>& alike, int dimension) {
  std::string off;
  if (cut.wrong > 0) off += fmt::format(", though it does not hold on about {:.2g} of these", cut.wrong);
  if (cut.missed > 0) off += fmt::format(", and it holds on about {:.2g} more", cut.missed);
  return warning<"cut-faces">(cut.selection->origin, cut.selection->where->text(), dimension == 2 ? "edges" : "faces",
                              cut.picked, off,
                              alike.empty() ? "" : fmt::format("; the same at {}", fmt::join(alike, ", ")));
}

/// One for each expression, which may stand in several places.
template <int D>
Warnings cut_warnings(const std::vector<CutSelection>& cuts) {
  Warnings warnings;
  std::vector<const CutSelection*> told;
  for (const CutSelection& cut : cuts) {
    const auto same = [&](const CutSelection* other) {
      return other->selection->where->text() == cut.selection->where->text() &&
             other->selection->part == cut.selection->part && other->wrong == cut.wrong && other->missed == cut.missed;
    };
    if (std::ranges::any_of(told, same)) continue;
    told.push_back(&cut);
    std::vector<std::string> alike;
    for (const CutSelection& other : cuts)
      if (&other != &cut && same(&other)) alike.push_back(other.selection->origin);
    warnings.push_back(cut_warning(cut, alike, D));
  }
  return warnings;
}

/// An expression of t says where an obstacle is, and not how it moves along its own surface.
bool drags_unknown(const Scene::Obstacle& obstacle) {
  const auto* shape = obstacle.shape ? std::get_if<Scene::ExpressionShape>(&*obstacle.shape) : nullptr;
  if (!shape) return false;
  return shape->distance.uses_t() || std::ranges::any_of(shape->normal, [](const Field& n) { return n.uses_t(); });
}

}  // namespace

/// Of a fix or a load at a point or along an edge.
template <int D, int B>
void warn_of_small(const Nodes<D>& nodes, const Selection& on, const char* what, Warnings& warnings) {
  if (on.picks_faces()) return;
  const bool point = !on.at.empty() || D == 2;
  warnings.push_back(warning<"singular">(on.origin, what, point ? "at a point" : "along an edge",
                                         B == D && point ? ", and so does its displacement" : ""));
  if (on.at.empty()) return;
  const NearVertex near = nearest_vertex(nodes, on);
  double size = 0;
  for (const double x : nodes.at(near.node)) size = std::max(size, std::fabs(x));
  if (near.distance > rounding_of_bases * size)
    warnings.push_back(warning<"off-vertex">(on.origin, fmt::format("{}", fmt::join(on.at, ", ")),
                                             fmt::format("{}", fmt::join(nodes.at(near.node), ", ")), near.distance));
}

template <int D, int B>
Warnings model_warnings(const Scene& scene, const Nodes<D>& nodes, const Model<B>& model, std::size_t body) {
  Warnings warnings;
  const std::vector<int> fixes = numbers_of(scene.fixes, scene.bodies[body]);
  for (const FixConflict& conflict : fix_conflicts(nodes, model))
    warnings.push_back(warning<"conflicting-fixes">(scene.fixes[fixes[conflict.later]].source.table,
                                                    scene.fixes[fixes[conflict.earlier]].source.table,
                                                    conflict.vertices, conflict.vertices == 1 ? "vertex" : "vertices"));
  for (Warning& warning : cut_warnings<D>(cut_selections(nodes.mesh(), model))) warnings.push_back(std::move(warning));
  for (const Fix<B>& fix : model.fixes) warn_of_small<D, B>(nodes, fix.on, "a fix", warnings);
  for (const Load<B>& load : model.loads)
    if (load.on) warn_of_small<D, B>(nodes, *load.on, "a load", warnings);
  const std::vector<int> obstacles = numbers_of(scene.obstacles, scene.bodies[body]);
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const Scene::Obstacle& obstacle = scene.obstacles[obstacles[k]];
    if (!model.obstacles[k].obstacle->functional() || !drags_unknown(obstacle)) continue;
    warnings.push_back(warning<"unknown-drag">(obstacle.source.of("distance")));
  }
  return warnings;
}

#define SIGNORINI_RESULTS(D, B)                                                                                  \
  template Results<D, B> results<D, B>(const Nodes<D>&, const Model<B>&, const Discretization<B>&,               \
                                       std::vector<double>, std::vector<double>, std::vector<SlaveChoice>,       \
                                       std::vector<Point<B>>, JointLoad<B>);                                     \
  template StepReport step_report(const Scene&, const Nodes<D>&, const Probes<D>&, const Results<D, B>&, double, \
                                  const Summary&, std::size_t);                                                  \
  template Warnings model_warnings(const Scene&, const Nodes<D>&, const Model<B>&, std::size_t);
SIGNORINI_RESULTS(2, 1)
SIGNORINI_RESULTS(3, 1)
SIGNORINI_RESULTS(2, 2)
SIGNORINI_RESULTS(3, 3)

template Probes<2> locate_probes(const Mesh<2>&, const Scene&, std::size_t);
template Probes<3> locate_probes(const Mesh<3>&, const Scene&, std::size_t);
template Warnings scene_warnings(const Scene&, const Mesh<2>&, std::size_t);
template Warnings scene_warnings(const Scene&, const Mesh<3>&, std::size_t);

}  // namespace signorini
