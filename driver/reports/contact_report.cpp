#include "driver/reports/contact_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/fem/elements/symmetric_motion.hpp"
#include "core/mesh/mirror.hpp"
#include "core/scene/reference_point.hpp"
#include "driver/reports/moments.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini {
namespace {

template <class Array>
std::vector<double> list(const Array& array) {
  return {array.begin(), array.end()};
}

template <int B>
ContactReport totals(const ContactSummary<B>& contact, const std::optional<DeformedContact>& deformed) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const DeformedContact at = deformed.value_or(DeformedContact{unknown, unknown, unknown, 0, 0, unknown});
  ContactReport report;
  report.nodes = contact.nodes;
  report.tied = contact.tied;
  report.area = contact.area;
  report.force = list(contact.force);
  report.max_pressure = contact.max_pressure;
  report.resolved = contact.resolved;
  report.peaks_at_edge = contact.peaks_at_edge;
  report.slip_nodes = contact.slip_nodes;
  report.stick_nodes = contact.stick_nodes;
  report.normal_force = report.force;
  for (int i = 0; i < B; ++i) report.normal_force[i] -= contact.tangential_force[i];
  report.tangential_force = list(contact.tangential_force);
  report.dissipated_in_step = report.dissipated = contact.dissipated;
  report.undetermined_nodes = contact.undetermined_nodes;
  report.undetermined_force = contact.undetermined_force;
  report.largest_penetration = at.penetration;
  report.largest_opening = at.opening;
  report.depth = at.depth;
  report.off = at.off;
  report.over_edge = at.over_edge;
  report.largest_displacement = at.displacement;
  report.beyond_nodes = at.beyond;
  return report;
}

/// Of what the obstacle stands for beyond planes of symmetry, too.
template <int B>
ContactSummary<B> of_whole(ContactSummary<B> contact, const Whole& whole) {
  contact.area *= whole.copies();
  contact.force = whole.total(contact.force);
  contact.tangential_force = whole.total(contact.tangential_force);
  contact.undetermined_force *= whole.copies();
  contact.dissipated *= whole.copies();
  return contact;
}

/// Of the strip, the disk or the ball with that measure.
/// @param inside the obstacle acts on all of the body, as those of scalars do, else on its boundary
double radius(int dimension, Plane plane, bool inside, double measure) {
  const int of_contact = dimension - (inside ? 0 : 1) + (plane == Plane::axisymmetric ? 1 : 0);
  if (of_contact == 1) return measure / 2;
  return of_contact == 2 ? std::sqrt(measure / std::numbers::pi) : std::cbrt(0.75 * measure / std::numbers::pi);
}

/// Where nodes of both bodies were when these found each other: as they are drawn, or masters moved by what those that
/// touch have moved by in the mean, and slaves past them.
template <int D>
class WhereTheyMet {
 public:
  WhereTheyMet(const Nodes<D>& nodes, Plane plane, const Results<D, D>& results)
      : nodes_(nodes), shift_(results.shift), of_masters_(shift_.size()) {
    std::vector<double> count(shift_.size());
    for (const ContactNode<D>& node : results.masters) {
      if (shift_.empty() || !node.contact || shift_[node.obstacle] == Point<D>{}) continue;
      ++count[node.obstacle];
      for (int i = 0; i < D; ++i) of_masters_[node.obstacle][i] += results.u[Offset{node.vertex} * D + i];
    }
    for (std::size_t k = 0; k < count.size(); ++k) {
      for (double& component : of_masters_[k]) component /= std::max(count[k], 1.0);
      of_masters_[k] = symmetric_motion<D>(nodes.mesh(), plane, of_masters_[k]);
    }
  }
  Point<D> operator()(Index node, Index obstacle, bool on_slave) const {
    Point<D> at = nodes_.control_point(node);
    for (int i = 0; i < D && !shift_.empty(); ++i)
      at[i] += of_masters_[obstacle][i] + (on_slave ? shift_[obstacle][i] : 0);
    return at;
  }

 private:
  const Nodes<D>& nodes_;
  const std::vector<Point<D>>& shift_;
  std::vector<Point<D>> of_masters_;  // per obstacle
};

template <int D, int B>
void add_moments(const Nodes<D>& nodes, Plane plane, const Results<D, B>& results,
                 std::vector<ContactReport>& reports) {
  if constexpr (B == D) {
    for (ContactReport& report : reports) {
      report.moment.resize(moment_entries<D>);
      if (report.pair) report.pair->moment.resize(report.moment.size());
    }
    if (plane == Plane::axisymmetric) return;  // all around the axis they cancel
    const WhereTheyMet<D> where(nodes, plane, results);
    const auto add = [&](Index node, Index obstacle, const std::array<double, B>& force, bool on_other) {
      ContactReport& report = reports[obstacle];
      const Point<D> at = where(node, obstacle, on_other == results.slaves[obstacle].exchanged);
      add_moment<D>(nodes.mesh().mirrors, results.across.obstacles[obstacle], at, force, report.moment_about,
                    on_other ? report.pair->moment : report.moment);
    };
    for (const ContactNode<B>& node : results.contact.nodes)
      add(node.vertex, node.obstacle, node.force, results.slaves[node.obstacle].exchanged);
    for (const TieForce<B>& tie : results.ties)
      add(tie.node, tie.obstacle, tie.force, results.slaves[tie.obstacle].exchanged);
    for (const NodalForce<B>& back : results.counterforces)
      add(back.node, back.obstacle, back.force, back.on_slave == results.slaves[back.obstacle].exchanged);
  }
}

void turn_round(std::vector<double>& force) {
  for (double& component : force) component = -component;
}

/// The body that the report is about may be the master.
template <int B>
void add_pair(const Scene::Obstacle& obstacle, const SlaveChoice& choice, const std::array<double, B>& on_body,
              const std::array<double, B>& on_other, ContactReport& report) {
  const bool exchanged = choice.exchanged;
  report.pair =
      PairReport{side_of(obstacle, exchanged), side_of(obstacle, !exchanged), choice.reason, list(on_other), {}};
  if (!exchanged) return;
  report.force = list(on_body);
  turn_round(report.normal_force);
  turn_round(report.tangential_force);
}

/// Nodes that are open, and the mean displacement of those that each obstacle may reach.
template <int D, int B>
void add_reachable(const Results<D, B>& results, std::vector<ContactReport>& reports) {
  std::vector<double> area(reports.size());
  std::vector<Index> last(reports.size(), -1), count(reports.size());  // a node has an entry for each direction
  for (ContactReport& report : reports) report.displacement.resize(B);
  const auto add = [&](Index obstacle, Index node, double of_node) {
    count[obstacle] += last[obstacle] != node;
    last[obstacle] = node;
    area[obstacle] += of_node;
    for (int i = 0; i < B; ++i) reports[obstacle].displacement[i] += of_node * results.u[std::size_t(node) * B + i];
  };
  for (const ContactNode<B>& node : results.contact.nodes) add(node.obstacle, node.vertex, node.area);
  for (const TieForce<B>& tie : results.ties) add(tie.obstacle, tie.node, tie.area);
  for (std::size_t k = 0; k < reports.size(); ++k) reports[k].open_nodes = count[k] - reports[k].nodes;
  for (std::size_t k = 0; k < reports.size(); ++k)
    for (double& u : reports[k].displacement) u = area[k] > 0 ? u / area[k] : 0;
}

}  // namespace

template <int D, int B>
ContactForces<B> contact_forces(const Results<D, B>& results) {
  ContactForces<B> out{results.forces.contact, totals(results.counterforces, results.forces.contact.size())};
  for (std::size_t k = 0; k < out.on_body.size(); ++k)
    if (results.slaves[k].exchanged) std::swap(out.on_body[k], out.on_other[k]);
  return out;
}

template <int D, int B>
std::vector<ContactReport> contact_reports(const Scene& scene, const Nodes<D>& nodes, const Results<D, B>& results,
                                           double t, std::size_t body) {
  const std::vector<int> numbers = numbers_of(scene.obstacles, scene.bodies[body]);
  const ContactForces<B> forces = contact_forces(results);
  std::vector<Whole> whole;
  for (const Planes across : results.across.obstacles) whole.emplace_back(nodes.mesh().mirrors, across);
  std::vector<ContactReport> reports;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    ContactReport& report =
        reports.emplace_back(totals(of_whole(results.contact.obstacles[k], whole[k]), results.deformed[k]));
    report.penetration_between_nodes = results.between_nodes[k];
    report.obstacle = numbers[k];
    const Scene::Obstacle& obstacle = scene.obstacles[numbers[k]];
    report.body = obstacle.body;
    if (!obstacle.other.empty())
      add_pair<B>(obstacle, results.slaves[k], whole[k].total(forces.on_body[k]), whole[k].total(forces.on_other[k]),
                  report);
    if (B == 1) continue;
    const std::array<double, 3> about = reference_point(obstacle, t), start = reference_point(obstacle, 0);
    report.moment_about.assign(about.begin(), about.begin() + D);
    for (int i = 0; i < D; ++i) report.motion.push_back(about[i] - start[i]);
  }
  for (const BoltState& bolt : results.bolts)
    reports[bolt.obstacle].bolt = {bolt.force * whole[bolt.obstacle].copies(), bolt.shortening, bolt.locked};
  add_moments(nodes, scene.bodies[body].plane, results, reports);
  for (ContactReport& report : reports) {
    const bool inside = B == 1 && !scene.obstacles[report.obstacle].on;
    report.radius = radius(D, scene.bodies[body].plane, inside, report.area);
  }
  add_reachable(results, reports);
  for (std::size_t k = 0; k < reports.size(); ++k)
    for (std::size_t i = 0; i < D && B == D; ++i)
      if (whole[k].cancels(static_cast<int>(i))) reports[k].displacement[i] = 0;
  return reports;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                \
  template ContactForces<B> contact_forces(const Results<D, B>&);                                                  \
  template std::vector<ContactReport> contact_reports(const Scene&, const Nodes<D>&, const Results<D, B>&, double, \
                                                      std::size_t);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
