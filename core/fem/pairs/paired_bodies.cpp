#include "core/fem/pairs/paired_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "core/fem/pairs/added_gap.hpp"
#include "core/fem/pairs/contact_pairs.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/pairs/pretension.hpp"
#include "core/fem/pairs/rigid_parts.hpp"
#include "core/fem/pairs/tied_sides.hpp"
#include "core/solver/jump_builder.hpp"

namespace signorini {
namespace {

/// What is left of a normal up to which a fix counts as being across it, with friction: cosine of 10 degrees, by which
/// a curved surface may be inclined at a plane of symmetry.
constexpr double nearly_across = 0.985;

/// Where the bodies of an obstacle overlap most at the start, with what its option `gap` adds to their distance. What
/// is deep is known by the nearest faces; how far `gap` presses bodies that are apart, by the pairs.
template <int D>
Overlap<D> deepest_overlap(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const PairedFaces& sides, double t,
                           const DeepestOverlap<D>& of_pairs) {
  const auto overlap = start_overlap<D>(mesh, term, sides, t);
  if (of_pairs.slave_face < 0) return overlap.value_or(Overlap<D>{});
  const Index face = sides.slave[of_pairs.slave_face];
  const bool pressed = added_on_face<D>(mesh, term, of_pairs.place, face) < 0;
  if (!overlap || (pressed && of_pairs.depth > overlap->depth)) return {of_pairs.depth, of_pairs.place, face};
  return *overlap;
}

/// More than an element of the coarsest mesh: what is admitted does not depend on refinement.
template <int D>
void refuse_deep(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const Overlap<D>& deepest) {
  if (deepest.slave_face < 0) return;
  if (deepest.depth <= term.adjust) return;
  if (deepest.depth <= std::ldexp(longest_edge(mesh, mesh.boundary[deepest.slave_face]), mesh.refinements)) return;
  input_error(term.origin,
              fmt::format("the bodies overlap at the start, by {:.4g} at ({:.6g}), which is more than an "
                          "element of the coarsest mesh; expected bodies apart from each other, or touching, or "
                          "resolve = true, which presses them apart",
                          deepest.depth, fmt::join(deepest.place, ", ")));
}

/// Couples ties one after the other, and then what may touch.
template <int D>
class Coupler {
 public:
  Coupler(const Nodes<D>& nodes, const Model<D>& model, const std::vector<FixedDirections<D>>& fixes,
          const std::vector<Point<D>>& shift)
      : nodes_(nodes), model_(model), fixes_(fixes), shift_(shift), slave_of_(nodes.size(), -1) {
    out_.rigid = add_rigid_parts(nodes, model, jumps_);
    for (const RigidNodes<D>& part : out_.rigid) take(part.nodes);
  }

  /// Ties come before contact: what is tied touches nothing else any more.
  void tie(Index obstacle) {
    const ObstacleTerm<D>& term = model_.obstacles[obstacle];
    const PairedFaces faces = paired_faces(nodes_.mesh(), term, model_.t);
    const MortarCoupling<D> found = couple_tied<D>(nodes_, model_, term, faces, fixes_, taken_);
    const std::size_t before = out_.ties.size();
    std::map<Index, TieRow<D>> rows;
    for (Index k = 0; k < found.nodes(); ++k) {
      const Index p = nodes_.of_vertex(found.node[k]);
      const BlockRow<D> seen = projected(found, k, onto_free(p));
      refuse_rigid(p, obstacle);
      if (jumps_.has(p) || jumps_.leads_to(seen, p)) continue;  // where ties meet the others hold it
      jumps_.add(p, seen);
      rows[p] = {seen, found.part(k)};
      out_.ties.push_back({p, obstacle, found.covered[k] + found.taken[k]});
    }
    if (out_.ties.size() == before) refuse_untied(term);
    if (term.pretension)
      out_.pretensioned.push_back(pretension<D>(nodes_, model_, obstacle, faces.slave, fixes_, rows, jumps_));
    std::vector<Index> tied;
    for (std::size_t k = before; k < out_.ties.size(); ++k) tied.push_back(out_.ties[k].node);
    take(tied);
  }

  void touch() {
    std::vector<Index> left_out = of_other_obstacles(nodes_.mesh(), model_);
    left_out.insert(left_out.end(), taken_.begin(), taken_.end());
    std::ranges::sort(left_out);
    left_out.erase(std::unique(left_out.begin(), left_out.end()), left_out.end());
    std::vector<ContactPair<D>> pairs;
    for (Index k = 0; k < std::ssize(model_.obstacles); ++k) {
      const ObstacleTerm<D>& term = model_.obstacles[k];
      if (!term.other || term.tied) continue;
      const PairedFaces faces = paired_faces(nodes_.mesh(), term, model_.t);
      const ContactPair<D>& pair =
          pairs.emplace_back(nodes_, model_, fixes_, k, faces, shifted_points(k, faces.slave), left_out);
      if (shift_.empty() && !term.resolve)
        refuse_deep<D>(nodes_.mesh(), term,
                       deepest_overlap<D>(nodes_.mesh(), term, faces, model_.t, pair.coupling().deepest));
    }
    share_slaves(pairs);
    for (ContactPair<D>& pair : pairs) {
      const std::size_t before = out_.nodes.size();
      add(pair);
      if (out_.nodes.size() == before)
        refuse_tied(pair.term(), paired_faces(nodes_.mesh(), pair.term(), model_.t).slave);
    }
  }

  std::shared_ptr<const PairedBodies<D>> take() {
    std::ranges::sort(out_.ties, {}, &TiedNode::node);
    std::ranges::sort(seen_, {}, &Seen::node);
    MasterMeans means;
    for (const Seen& seen : seen_) {
      means.node.push_back(seen.node);
      means.column.insert(means.column.end(), seen.column.begin(), seen.column.end());
      means.weight.insert(means.weight.end(), seen.weight.begin(), seen.weight.end());
      means.row.push_back(static_cast<Offset>(means.column.size()));
    }
    out_.jumps = std::make_shared<const Jumps<D>>(jumps_.take());
    out_.means = std::make_shared<const MasterMeans>(std::move(means));
    return std::make_shared<const PairedBodies<D>>(std::move(out_));
  }

 private:
  struct Seen {  // see MasterMeans
    Index node;
    std::vector<Index> column;
    std::vector<double> weight;
  };

  [[noreturn]] void refuse_untied(const ObstacleTerm<D>& term) const {
    input_error(term.origin,
                "ties no node: no face of one body is in front of the other one's and turned towards it, or fixes "
                "prescribe all that is; expected faces of the two bodies that lie on each other ('on', 'other_on')");
  }

  /// Of a slave without any node that may touch.
  void refuse_tied(const ObstacleTerm<D>& term, const std::vector<Index>& slave) const {
    std::map<Index, Index> tied;
    for (const TiedNode& tie : out_.ties) tied[tie.node] = tie.obstacle;
    Index by = -1;
    for (const Index f : slave)
      for (const Index v : nodes_.mesh().boundary[f].vertices) {
        const auto tie = tied.find(nodes_.of_vertex(v));
        if (tie == tied.end()) return;
        by = tie->second;
      }
    if (by >= 0)
      input_error(term.origin,
                  fmt::format("all of the slave is tied to the other body by {}, so that these cannot touch "
                              "each other there; expected faces apart from these",
                              model_.obstacles[by].origin));
  }

  /// No other side has these nodes.
  void take(const std::vector<Index>& nodes) {
    for (const Index p : nodes) taken_.push_back(nodes_.vertex(p));
    std::ranges::sort(taken_);
  }

  /// All around such a node is rigid, too.
  void refuse_rigid(Index p, Index obstacle) const {
    for (std::size_t k = 0; k < out_.rigid.size(); ++k)
      if (std::ranges::binary_search(out_.rigid[k].nodes, p))
        input_error(
            model_.obstacles[obstacle].origin,
            fmt::format("at ({}) {} moves the slave, which has no unknowns of its own there; expected the other "
                        "body as the slave ('slave'), or faces apart from these",
                        fmt::join(nodes_.at(p), ", "), model_.rigid[k].on.origin));
  }

  /// The weights of a node, of which a projector leaves some directions.
  BlockRow<D> projected(const MortarCoupling<D>& found, Index k, const std::array<double, D * D>& P) const {
    BlockRow<D> out;
    for (Offset j = found.row[k]; j < found.row[k + 1]; ++j) {
      auto& W = out[nodes_.of_vertex(found.column[j])];
      for (int i = 0; i < D * D; ++i) W[i] += found.value[j] * P[i];
    }
    return out;
  }

  void add(ContactPair<D>& pair) {
    std::map<Index, BlockRow<D>> rows = rows_of(pair);
    std::vector<Index> dropped;
    for (std::vector<Index> circle; !(circle = jumps_.circles(rows)).empty();) {
      leave_out(pair, circle);
      std::ranges::copy_if(circle, std::back_inserter(dropped), [&](Index p) { return pair.has(nodes_.vertex(p)); });
      rows = rows_of(pair);
      for (const Index p : dropped) rows.erase(p);
    }
    if (!dropped.empty()) lose({dropped.front(), pair.obstacle()});
    const MortarCoupling<D>& found = pair.coupling();
    bool free = false;
    for (Index k = 0; k < found.nodes(); ++k) {
      free = free || pair.free(k);
      if (const auto row = rows.find(nodes_.of_vertex(found.node[k])); row != rows.end())
        add(pair, k, std::move(row->second));
    }
    if (taken_.empty() && found.nodes() > 0 && !free)
      input_error(pair.term().origin,
                  "the displacement of all nodes of the slave is prescribed, or that along the normal: nothing keeps "
                  "the master off them; expected free nodes, or the other body as the slave");
  }

  /// Where masters depend on the slave's nodes, as with friction at a point where bodies meet all around it, these are
  /// left out.
  void leave_out(ContactPair<D>& pair, std::vector<Index> circle) const {
    for (Index& p : circle) p = nodes_.vertex(p);
    pair.leave_out(std::move(circle));
  }

  void lose(LostNode node) {
    if (!out_.lost) out_.lost = node;
  }

  /// Of all nodes at which a condition holds.
  std::map<Index, BlockRow<D>> rows_of(const ContactPair<D>& pair) {
    const MortarCoupling<D>& found = pair.coupling();
    std::map<Index, BlockRow<D>> out;
    for (Index k = 0; k < found.nodes(); ++k) {
      const Index p = nodes_.of_vertex(found.node[k]);
      refuse_rigid(p, pair.obstacle());
      if (jumps_.has(p) && slave_of_[p] < 0) continue;  // tied
      const auto free = pair.free(k);
      if (free && slave_of_[p] >= 0)
        lose({p, pair.obstacle(), slave_of_[p]});
      else if (free)
        out[p] = projected(found, k, pair.term().obstacle->functional() ? onto_free(p) : along(*free, pair.normal(k)));
    }
    return out;
  }

  /// @param row of the jump
  void add(const ContactPair<D>& pair, Index k, BlockRow<D> row) {
    const MortarCoupling<D>& found = pair.coupling();
    const Index p = nodes_.of_vertex(found.node[k]), obstacle = pair.obstacle();
    const Point<D> normal = pair.normal(k);
    const std::optional<FreeNormal<D>> free = pair.free(k);
    const bool with_friction = pair.term().obstacle->functional() != nullptr;
    if (with_friction && free->part < nearly_across) refuse_inclined(p, obstacle);
    slave_of_[p] = obstacle;
    PairedNode<D>& node = out_.nodes.emplace_back(PairedNode<D>{p, obstacle, {}, 0});
    // Bounds are reduced to what is free later on, but for friction, whose coordinates are to be free.
    for (int i = 0; i < D; ++i) node.away[i] = with_friction ? -free->direction[i] : -normal[i];
    const double before = shift_.empty() ? 0 : dot(shift_[obstacle], normal);
    node.part = found.part(k);
    node.covered = found.covered[k];
    node.taken = found.taken[k];
    node.gap = found.distance(k) + before;
    if (std::abs(node.gap) <= pair.term().adjust) node.gap = 0;
    if (with_friction) node.gap = (node.gap - free->prescribed) / free->part;
    Seen& seen = seen_.emplace_back(Seen{p, {}, {}});
    for (Offset j = found.row[k]; j < found.row[k + 1]; ++j) {
      seen.column.push_back(nodes_.of_vertex(found.column[j]));
      seen.weight.push_back(found.value[j]);
    }
    jumps_.add(p, std::move(row));
  }

  /// All of the slave's body is moved, for what is inside it is looked for; of a body that touches itself its side.
  std::vector<Point<D>> shifted_points(Index obstacle, const std::vector<Index>& slave) const {
    if (shift_.empty()) return {};
    const ObstacleTerm<D>& term = model_.obstacles[obstacle];
    const auto moved = of_one_body(term) ? slave : faces_of_body(nodes_.mesh(), *term.on, model_.t);
    std::vector<Point<D>> points = nodes_.mesh().points;
    for (const Index f : moved)
      for (const Index v : nodes_.mesh().boundary[f].vertices)
        for (int i = 0; i < D; ++i) points[v][i] = nodes_.mesh().points[v][i] + shift_[obstacle][i];
    return points;
  }

  [[noreturn]] void refuse_inclined(Index p, Index obstacle) const {
    input_error(
        model_.obstacles[obstacle].origin,
        fmt::format("with friction, meets a direction prescribed at ({}) that is neither along the slave's normal "
                    "nor across it, which is not available in this version; expected the other body as the "
                    "slave, or another fix",
                    fmt::join(nodes_.at(p), ", ")));
  }

  std::array<double, D * D> onto_free(Index p) const {
    const FixedDirections<D>* fixed = fixed_at(fixes_, p);
    std::array<double, D * D> out{};
    for (int i = 0; i < D; ++i) out[i * (D + 1)] = 1;
    for (int k = 0; fixed && k < fixed->count; ++k)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) out[i * D + j] -= fixed->direction[k][i] * fixed->direction[k][j];
    return out;
  }

  /// Along the surfaces only friction holds the bodies together. What the master moves along the normal the slave's
  /// node makes up for along what is free of it: oblique where these differ.
  static std::array<double, D * D> along(const FreeNormal<D>& free, const Point<D>& normal) {
    std::array<double, D * D> out;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) out[i * D + j] = free.direction[i] * normal[j] / free.part;
    return out;
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const std::vector<FixedDirections<D>>& fixes_;
  const std::vector<Point<D>>& shift_;
  std::vector<Index> slave_of_;  // per node: obstacle, -1: none
  JumpBuilder<D> jumps_;
  std::vector<Seen> seen_;
  std::vector<Index> taken_;  // vertices of rigid parts and ties, ascending
  PairedBodies<D> out_;
};

}  // namespace

template <int D>
std::shared_ptr<const PairedBodies<D>> pair_bodies(const Nodes<D>& nodes, const Model<D>& model,
                                                   const std::vector<FixedDirections<D>>& fixes,
                                                   const std::vector<Point<D>>& shift) {
  if (!changes_unknowns(model)) return nullptr;
  Coupler<D> coupler(nodes, model, fixes, shift);
  for (Index k = 0; k < std::ssize(model.obstacles); ++k)
    if (model.obstacles[k].other && model.obstacles[k].tied) coupler.tie(k);
  coupler.touch();
  return coupler.take();
}

template <int D>
void refuse_lost(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& pairs) {
  if (!pairs.lost) return;
  const auto [node, obstacle, by] = *pairs.lost;
  input_error(
      model.obstacles[obstacle].origin,
      fmt::format("at ({}) {}, and so at all nodes of an element's face, which is not available in this version; "
                  "expected one obstacle with the faces of both, where they are between the same two bodies; else "
                  "smaller elements there, quadratic ones, the other body as the slave ('slave'), or faces apart from "
                  "each other",
                  fmt::join(nodes.at(node), ", "),
                  by >= 0 ? fmt::format("{} lets the slave touch another body", model.obstacles[by].origin)
                          : "what the slave touches is held by the slave itself through others"));
}

namespace {

/// Of sides that do not face each other: the difference of their means.
template <int D>
Slip<D> slip_of_sides(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, const std::vector<double>& u) {
  const PairedFaces faces = paired_faces(nodes.mesh(), model.obstacles[obstacle], model.t);
  Slip<D> out;
  const auto add_mean = [&](const std::vector<Index>& side, double sign) {
    const Surface<D> of = surface(nodes, side);
    for (const Index p : of.nodes)
      for (int i = 0; i < D; ++i) out.mean[i] += sign * u[Offset{p} * D + i] / static_cast<double>(of.nodes.size());
  };
  add_mean(faces.slave, 1);
  add_mean(faces.master, -1);
  for (const Index f : faces.slave)
    out.length += longest_edge(nodes.mesh(), nodes.mesh().boundary[f]) / static_cast<double>(faces.slave.size());
  return out;
}

}  // namespace

template <int D>
Slip<D> slip_past(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, const PairedBodies<D>& all,
                  const PairedBodies<D>& near, const std::vector<double>& u) {
  std::vector<double> length(static_cast<std::size_t>(nodes.size()));
  for (const Index f : select_faces(nodes.mesh(), *model.obstacles[obstacle].on, model.t))
    for (const Index p : nodes.of_face(f))
      length[p] = std::max(length[p], longest_edge(nodes.mesh(), nodes.mesh().boundary[f]));
  const bool any = std::ranges::find(near.nodes, obstacle, &PairedNode<D>::obstacle) != near.nodes.end();
  const PairedBodies<D>& pairs = any ? near : all;
  const MasterMeans& means = *pairs.means;
  Slip<D> out;
  double count = 0;
  for (const PairedNode<D>& node : pairs.nodes) {
    if (node.obstacle != obstacle) continue;
    const auto s = std::ranges::lower_bound(means.node, node.node) - means.node.begin();
    for (int i = 0; i < D; ++i) {
      double jump = u[Offset{node.node} * D + i];
      for (Offset k = means.row[s]; k < means.row[s + 1]; ++k)
        jump -= means.weight[k] * u[Offset{means.column[k]} * D + i];
      out.mean[i] += jump / node.part;
    }
    out.length += length[node.node];
    ++count;
  }
  if (count == 0) {
    out = slip_of_sides(nodes, model, obstacle, u);
  } else {
    for (double& c : out.mean) c /= count;
    out.length /= count;
  }
  out.mean = symmetric_motion<D>(nodes.mesh(), model.plane, out.mean);
  return out;
}

namespace {

/// What is left between the bodies at each pair, and how much they have come nearer there at most.
struct Distances {
  std::vector<double> left;       // by the number of the jump
  std::vector<char> acts_anyway;  // likewise: whether or not they touch, as what is tied
  double closed = 0;
  double moved = 0;  // by how much bodies have moved at most there
};

/// Whether a functional acts on bodies that do not touch: all do but friction that only what presses causes.
template <int D>
bool acts_anyway(const Obstacle<D>& obstacle, const FunctionalNumbers<D>& numbers) {
  const Friction* friction = obstacle.friction();
  return !friction || friction->law(numbers.data.data()).bound != 0;
}

template <int D>
bool is_rigid(const PairedBodies<D>& pairs, Index node) {
  return std::ranges::any_of(pairs.rigid,
                             [&](const auto& part) { return std::ranges::binary_search(part.nodes, node); });
}

template <int D>
Distances distances(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& all, std::vector<double> u) {
  const Jumps<D>& jumps = *all.jumps;
  Distances out{std::vector<double>(jumps.vector.size(), infinity), std::vector<char>(jumps.vector.size())};
  for (const Index p : jumps.vector)
    for (int i = 0; i < D; ++i) out.moved = std::max(out.moved, std::abs(u[Offset{p} * D + i]));
  to_jumps(jumps, u);
  for (const TiedNode& tie : all.ties)
    out.acts_anyway[std::ranges::lower_bound(jumps.vector, tie.node) - jumps.vector.begin()] = true;
  for (Index s = 0; s < jumps.size(); ++s) out.acts_anyway[s] |= is_rigid(all, jumps.vector[s]);
  std::vector<FunctionalNumbers<D>> numbers;
  for (const Bound<D>& bound : collect_bounds(nodes, model, numbers, &all)) {
    if (!model.obstacles[bound.obstacle].other) continue;
    double along = 0;
    for (int i = 0; i < D; ++i) along += bound.direction[i] * u[Offset{bound.vertex} * D + i];
    const auto at = std::ranges::lower_bound(jumps.vector, bound.vertex) - jumps.vector.begin();
    out.left[static_cast<std::size_t>(at)] = std::min(along - bound.lower, bound.upper - along);
    if (bound.data >= 0 && acts_anyway(*model.obstacles[bound.obstacle].obstacle, numbers[bound.data]))
      out.acts_anyway[static_cast<std::size_t>(at)] = true;
    out.closed = std::max(out.closed, std::abs(along));
  }
  return out;
}

template <int D>
bool has(const PairedBodies<D>& pairs, Index node) {
  return std::ranges::binary_search(pairs.jumps->vector, node);
}

/// All pairs that are among these jumps.
template <int D>
std::shared_ptr<const PairedBodies<D>> pairs_of(const PairedBodies<D>& all, std::shared_ptr<const Jumps<D>> jumps) {
  PairedBodies<D> out{{}, all.ties, all.rigid, all.pretensioned, all.lost, std::move(jumps), all.means};
  std::ranges::copy_if(all.nodes, std::back_inserter(out.nodes), [&](const auto& pair) { return has(out, pair.node); });
  return std::make_shared<const PairedBodies<D>>(std::move(out));
}

}  // namespace

template <int D>
std::shared_ptr<const PairedBodies<D>> near_contact(const Nodes<D>& nodes, const Model<D>& model,
                                                    const PairedBodies<D>& all, const std::vector<double>& u,
                                                    const PairedBodies<D>* also) {
  constexpr double near = 0.25;  // of what they have come nearer
  const Distances distance = distances(nodes, model, all, u);
  const Jumps<D>& jumps = *all.jumps;
  const double reach = std::max(near * distance.closed, rounding_of_differences * distance.moved);
  std::vector<char> keep(jumps.vector.size());
  for (std::size_t s = 0; s < keep.size(); ++s)
    keep[s] = distance.left[s] <= reach || distance.acts_anyway[s] || (also && has(*also, jumps.vector[s]));
  return pairs_of(all, std::make_shared<const Jumps<D>>(chosen_jumps(jumps, keep)));
}

template <int D>
bool same_jumps(const PairedBodies<D>& a, const PairedBodies<D>& b) {
  return std::ranges::equal(a.nodes, b.nodes,
                            [](const PairedNode<D>& p, const PairedNode<D>& q) {
                              return p.node == q.node && p.obstacle == q.obstacle && p.away == q.away;
                            }) &&
         *a.jumps == *b.jumps;
}

template <int D>
std::shared_ptr<const PairedBodies<D>> with_new_gaps(const PairedBodies<D>& all, const PairedBodies<D>& chosen) {
  return pairs_of(all, chosen.jumps);
}

template <int D>
bool touches_elsewhere(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& all,
                       const PairedBodies<D>& chosen, const std::vector<double>& u) {
  const Distances distance = distances(nodes, model, all, u);
  for (std::size_t s = 0; s < distance.left.size(); ++s)
    if ((distance.left[s] < 0 || distance.acts_anyway[s]) && !has(chosen, all.jumps->vector[s])) return true;
  return false;
}

template std::shared_ptr<const PairedBodies<2>> near_contact(const Nodes<2>&, const Model<2>&, const PairedBodies<2>&,
                                                             const std::vector<double>&, const PairedBodies<2>*);
template std::shared_ptr<const PairedBodies<3>> near_contact(const Nodes<3>&, const Model<3>&, const PairedBodies<3>&,
                                                             const std::vector<double>&, const PairedBodies<3>*);
template void refuse_lost(const Nodes<2>&, const Model<2>&, const PairedBodies<2>&);
template void refuse_lost(const Nodes<3>&, const Model<3>&, const PairedBodies<3>&);
template bool same_jumps(const PairedBodies<2>&, const PairedBodies<2>&);
template bool same_jumps(const PairedBodies<3>&, const PairedBodies<3>&);
template std::shared_ptr<const PairedBodies<2>> with_new_gaps(const PairedBodies<2>&, const PairedBodies<2>&);
template std::shared_ptr<const PairedBodies<3>> with_new_gaps(const PairedBodies<3>&, const PairedBodies<3>&);
template bool touches_elsewhere(const Nodes<2>&, const Model<2>&, const PairedBodies<2>&, const PairedBodies<2>&,
                                const std::vector<double>&);
template bool touches_elsewhere(const Nodes<3>&, const Model<3>&, const PairedBodies<3>&, const PairedBodies<3>&,
                                const std::vector<double>&);
template std::shared_ptr<const PairedBodies<2>> pair_bodies<2>(const Nodes<2>&, const Model<2>&,
                                                               const std::vector<FixedDirections<2>>&,
                                                               const std::vector<Point<2>>&);
template std::shared_ptr<const PairedBodies<3>> pair_bodies<3>(const Nodes<3>&, const Model<3>&,
                                                               const std::vector<FixedDirections<3>>&,
                                                               const std::vector<Point<3>>&);
template Slip<2> slip_past(const Nodes<2>&, const Model<2>&, Index, const PairedBodies<2>&, const PairedBodies<2>&,
                           const std::vector<double>&);
template Slip<3> slip_past(const Nodes<3>&, const Model<3>&, Index, const PairedBodies<3>&, const PairedBodies<3>&,
                           const std::vector<double>&);

}  // namespace signorini
