#include "core/fem/recovery/joint_pressure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/fem/assembly/resultant.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/recovery/contact.hpp"
#include "core/mesh/connected.hpp"

namespace signorini {
namespace {

std::size_t place(const std::vector<Index>& ascending, Index node) {
  return static_cast<std::size_t>(std::ranges::lower_bound(ascending, node) - ascending.begin());
}

}  // namespace

template <int D, int B>
JointPressure<D, B>::JointPressure(const Nodes<D>& nodes, const Model<B>& model) : nodes_(nodes), model_(model) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const Load<B>& load = model.loads[k];
    if (!load.where_open) continue;
    Joint& joint = joints_.emplace_back(Joint{k, surface(nodes, select_faces(nodes.mesh(), *load.on, model.t)), {}});
    if (!load.where_open->from) continue;
    const std::vector<Index> from = select_nodes(nodes, *load.where_open->from, model.t);
    std::ranges::set_intersection(joint.faces.nodes, from, std::back_inserter(joint.sources));
    if (joint.sources.empty())
      input_error(load.where_open->from->origin,
                  "the part that the pressure comes from has no node in common with the faces that it is to act on, "
                  "expected one that meets them");
  }
}

template <int D, int B>
Wetted JointPressure<D, B>::nowhere() const {
  Wetted out;
  for (const Joint& joint : joints_) out.emplace_back(joint.faces.nodes.size());
  return out;
}

template <int D, int B>
Wetted JointPressure<D, B>::wetted(const Discretization<B>& discretization, const std::vector<double>& x,
                                   const JointLoad<B>& present) const {
  const Pressed found = pressed(discretization, x, present);
  Wetted out;
  for (const Joint& joint : joints_) out.push_back(spread(joint, found));
  return out;
}

template <int D, int B>
typename JointPressure<D, B>::Pressed JointPressure<D, B>::pressed(const Discretization<B>& discretization,
                                                                   const std::vector<double>& x,
                                                                   const JointLoad<B>& present) const {
  Pressed out{std::vector<char>(static_cast<std::size_t>(nodes_.size())),
              std::vector<double>(static_cast<std::size_t>(nodes_.size()))};
  for (const ContactNode<B>& node : contact_state(nodes_, model_, discretization, x).nodes) {
    if (!node.contact) continue;
    double total = node.pressure;
    for (int i = 0; i < B && node.area > 0; ++i)
      total += present.force[Offset{node.vertex} * B + i] * node.direction[i] / node.area;
    double& known = out.total[node.vertex];  // by another obstacle
    known = out.contact[node.vertex] ? std::max(known, total) : total;
    out.contact[node.vertex] = true;
  }
  if (discretization.pairs)
    for (const TiedNode& tie : discretization.pairs->ties) {
      out.contact[tie.node] = true;
      out.total[tie.node] = infinity;
    }
  return out;
}

/// Of the load, per node of its faces.
template <int D, int B>
std::vector<double> JointPressure<D, B>::pressures(const Joint& joint) const {
  const std::vector<Point<D>> normals = node_normals(nodes_, joint.faces);
  std::vector<double> out;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const Point<D> x = nodes_.at(joint.faces.nodes[k]);
    const Site where = site<D>(x, model_.t, normals[k]);
    double p = 0;
    for (int i = 0; i < std::min(B, D); ++i) p -= model_.loads[joint.load].value[i](where) * normals[k][i];
    out.push_back(p);
  }
  return out;
}

template <int D, int B>
std::vector<char> JointPressure<D, B>::spread(const Joint& joint, const Pressed& pressed) const {
  const std::vector<Index>& nodes = joint.faces.nodes;
  const std::vector<double> own = pressures(joint);
  const auto gives_way = [&](std::size_t k) { return !pressed.contact[nodes[k]] || pressed.total[nodes[k]] < own[k]; };
  std::vector<char> out(nodes.size());
  std::vector<Index> next = joint.sources;
  if (!model_.loads[joint.load].where_open->from)
    std::ranges::copy_if(nodes, std::back_inserter(next), [&](Index p) { return !pressed.contact[p]; });
  while (!next.empty()) {
    const Index p = next.back();
    next.pop_back();
    const std::size_t at = place(nodes, p);
    if (out[at] || !gives_way(at)) continue;
    out[at] = true;
    for (Offset k = joint.faces.first[at]; k < joint.faces.first[at + 1]; ++k)
      for (const Index q : nodes_.of_face(joint.faces.around[k])) next.push_back(q);
  }
  return out;
}

template <int D, int B>
std::vector<double> JointPressure<D, B>::own_force(const Joint& joint, const std::vector<char>& wetted,
                                                   JointLoad<B>& out) const {
  const Load<B>& load = model_.loads[joint.load];
  std::vector<double> force(static_cast<std::size_t>(nodes_.size()) * B), acts(static_cast<std::size_t>(nodes_.size()));
  for (std::size_t k = 0; k < wetted.size(); ++k) acts[joint.faces.nodes[k]] = wetted[k];
  integrate_load(nodes_, model_, load, false, [&](const auto& point) {
    double part = 0;
    for (std::size_t a = 0; a < point.node.size(); ++a) part += point.value[a] * acts[point.node[a]];
    if (part == 0) return;
    out.area[joint.load] += point.weight * part;
    const Site where = site<D>(point.x, model_.t, point.normal);
    for (int i = 0; i < B; ++i) {
      const double f = point.weight * part * load.value[i](where);
      out.total[joint.load][i] += f;
      for (std::size_t a = 0; a < point.node.size(); ++a) force[Offset{point.node[a]} * B + i] += point.value[a] * f;
    }
  });
  return force;
}

/// Calls use(row, node, weight) for nodes of the master; rows have nodes of the slave as well, whose share theirs takes
/// over.
template <int D, int B>
template <class Use>
void JointPressure<D, B>::each_master(const MasterMeans& means, const Use& use) const {
  const std::vector<Index> body = connected_parts(nodes_.mesh());
  std::vector<char> slave(static_cast<std::size_t>(nodes_.size()));  // of any obstacle, by its side
  if constexpr (D == B)
    for (const ObstacleTerm<B>& term : model_.obstacles) {
      if (!term.other) continue;
      for (const Index p : surface(nodes_, paired_faces(nodes_.mesh(), term, model_.t).slave).nodes) slave[p] = true;
    }
  const auto is_own = [&](Index p, Index q) { return slave[q] && body[nodes_.ends(p)[0]] == body[nodes_.ends(q)[0]]; };
  for (std::size_t s = 0; s < means.node.size(); ++s)
    for (Offset k = means.row[s]; k < means.row[s + 1]; ++k)
      if (!is_own(means.node[s], means.column[k])) use(s, means.column[k], means.weight[k]);
}

template <int D, int B>
void JointPressure<D, B>::refuse_master(const Joint& joint, const PairedBodies<B>& pairs) const {
  const std::vector<Index>& slaves = pairs.means->node;
  std::vector<char> faced(static_cast<std::size_t>(nodes_.size()));
  each_master(*pairs.means, [&](std::size_t, Index q, double) { faced[q] = true; });
  for (const Index face : joint.faces.faces) {
    const auto around = nodes_.of_face(face);
    const bool master = std::ranges::all_of(around, [&](Index q) { return faced[q]; }) &&
                        std::ranges::none_of(around, [&](Index q) { return std::ranges::binary_search(slaves, q); });
    if (master)
      input_error(model_.loads[joint.load].on->origin,
                  fmt::format("at ({}) these faces are those of a master, and where they touch the other body is known "
                              "at the slave alone; expected the pressure on the other body's faces, or this body as "
                              "the slave ('slave' of the obstacle). It acts on both bodies in any case",
                              fmt::join(nodes_.at(around[0]), ", ")));
  }
}

/// Hands the force on nodes of a slave to the master, in the opposite direction: of each as much as the master is in
/// front of.
template <int D, int B>
void JointPressure<D, B>::hand_over(const std::vector<double>& own, const PairedBodies<B>& pairs,
                                    std::vector<double>& force) const {
  std::vector<double> bears(static_cast<std::size_t>(nodes_.size()));  // part of the node's area
  for (const PairedNode<B>& node : pairs.nodes) bears[node.node] += node.covered + node.taken;
  for (const TiedNode& tie : pairs.ties) bears[tie.node] += tie.bears;
  const MasterMeans& means = *pairs.means;
  std::vector<double> sum(means.node.size());
  each_master(means, [&](std::size_t s, Index, double weight) { sum[s] += weight; });
  each_master(means, [&](std::size_t s, Index q, double weight) {
    const Index p = means.node[s];
    for (int i = 0; i < B; ++i) force[Offset{q} * B + i] -= bears[p] * weight / sum[s] * own[Offset{p} * B + i];
  });
}

template <int D, int B>
JointLoad<B> JointPressure<D, B>::load(const Wetted& wetted, const PairedBodies<B>* pairs) const {
  JointLoad<B> out;
  if (none()) return out;
  out.force.resize(static_cast<std::size_t>(nodes_.size()) * B);
  out.total.resize(model_.loads.size());
  out.area.resize(model_.loads.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (pairs && pairs->means) refuse_master(joints_[j], *pairs);
    const std::vector<double> own = own_force(joints_[j], wetted[j], out);
    for (std::size_t k = 0; k < own.size(); ++k) out.force[k] += own[k];
    if (pairs && pairs->means) hand_over(own, *pairs, out.force);
  }
  return out;
}

template <int D, int B>
std::string JointPressure<D, B>::origin(const Wetted& wetted) const {
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (std::ranges::find(wetted[j], 1) != wetted[j].end()) return model_.loads[joints_[j].load].on->origin;
  return "";
}

bool Spreading::take(Wetted found) {
  shut_ = 0;
  for (std::size_t j = 0; j < now_.size(); ++j)
    for (std::size_t k = 0; k < now_[j].size(); ++k) {
      shut_ += now_[j][k] && !found[j][k];
      if (grows_) found[j][k] |= now_[j][k];
    }
  if (found == now_) return false;
  grows_ = grows_ || std::ranges::find(past_, found) != past_.end();
  past_.push_back(std::exchange(now_, std::move(found)));
  return true;
}

#define SIGNORINI_INSTANTIATE(D, B) template class JointPressure<D, B>;
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
