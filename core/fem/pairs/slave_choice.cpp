#include "core/fem/pairs/slave_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/dot.hpp"
#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/pairs/paired_sides.hpp"

namespace signorini {
namespace {

/// Moduli that differ by less than this factor take as many cycles whichever body is the slave: then accuracy decides.
constexpr double alike = 2;
/// The slave may be so much stiffer to have free nodes: cycles are five times as many then.
constexpr double far_stiffer = 100;
/// Contact is where bodies are closest: up to this part of a face's length farther apart. Bodies dent each other less
/// than that on meshes that show it.
constexpr double depth = 0.1;
/// Prescribed nodes count where contact may come to: up to this part of a face's length farther apart.
constexpr double within_reach = 1;
/// Faces that differ by less are of the same size.
constexpr double as_fine = 1.01;
/// Up to this factor moduli and faces are one: what the choice is by must not depend on rounding.
constexpr double the_same = 1 + 1e-6;

/// What is known of one of the two sides.
struct SideFacts {
  std::vector<Index> nodes;      ///< that see the other one, or are seen; ascending
  double modulus = 0, size = 0;  ///< near the other body; of faces
  PrescribedNodes fixed;
  std::string taken;  ///< by another obstacle: its name; empty: no

  bool prescribed() const { return fixed.all > 0 && fixed.normal == fixed.all; }
  bool may_be_slave() const { return !prescribed() && taken.empty(); }
};

/// Of a side the faces that are closest to the other body, or up to a part of their length farther apart.
template <int D>
std::vector<Index> closest(const Mesh<D>& mesh, const std::vector<Index>& faces, const MortarCoupling<D>& coupling,
                           double part) {
  if (coupling.nodes() == 0) return faces;
  const double least = *std::ranges::min_element(coupling.gap);
  const auto gap = [&](Index v) {
    const auto at = std::ranges::lower_bound(coupling.node, v);
    return at != coupling.node.end() && *at == v ? coupling.gap[static_cast<std::size_t>(at - coupling.node.begin())]
                                                 : infinity;
  };
  std::vector<Index> out;
  for (const Index f : faces) {
    const auto& corners = mesh.boundary[f].vertices;
    const double limit = least + part * longest_edge(mesh, mesh.boundary[f]);
    if (std::ranges::any_of(corners, [&](Index v) { return gap(v) <= limit; })) out.push_back(f);
  }
  return out;
}

template <int D>
class Chooser {
 public:
  Chooser(const Nodes<D>& nodes, const Model<D>& model)
      : nodes_(nodes),
        model_(model),
        fixes_(collect_fixes<D, D>(nodes, model)),
        first_(nodes.size(), -1),
        second_(nodes.size(), -1) {
    facts_.resize(model.obstacles.size());
    for (std::size_t k = 0; k < model.obstacles.size(); ++k)
      if (model.obstacles[k].other)
        look_at_pair(static_cast<Index>(k));
      else
        look_at_rigid(static_cast<Index>(k));
    for (std::size_t k = 0; k < model.rigid.size(); ++k)
      mark(static_cast<Index>(model.obstacles.size() + k),
           surface(nodes, select_faces(nodes.mesh(), model.rigid[k].on, model.t)).nodes);
  }

  SlaveChoice choose(Index k) {
    for (SideFacts& side : facts_[k]) side.taken = taker(side, k);
    const auto& [body, other] = facts_[k];
    if (body.may_be_slave() != other.may_be_slave()) {
      const bool exchanged = other.may_be_slave();
      const SideFacts& master = exchanged ? body : other;
      return {exchanged, master.prescribed() ? "the other side is prescribed"
                                             : fmt::format("{} acts on the other side, too", master.taken)};
    }
    for (const bool exchanged : {false, true})
      if (frees(exchanged ? other : body, exchanged ? body : other, model_.obstacles[k]))
        return {exchanged, "nodes of the other side are prescribed"};
    for (const auto& [stiffer, coarser] : {std::pair{alike * the_same, as_fine}, std::pair{the_same, the_same}}) {
      if (body.modulus > stiffer * other.modulus) return {true, softer(other, body)};
      if (other.modulus > stiffer * body.modulus) return {false, softer(body, other)};
      if (body.size > coarser * other.size) return {true, finer(other, body)};
      if (other.size > coarser * body.size) return {false, finer(body, other)};
    }
    return {false, "as stiff and as fine as the other one"};
  }

 private:
  /// Whether conditions are lost at the nodes of the other side, and not at those of this one.
  static bool frees(const SideFacts& slave, const SideFacts& master, const ObstacleTerm<D>& term) {
    if (term.obstacle->friction() && slave.fixed.without_friction() != master.fixed.without_friction())
      return master.fixed.without_friction();
    return slave.fixed.normal == 0 && master.fixed.normal > 0 && slave.modulus <= far_stiffer * master.modulus;
  }

  void look_at_pair(Index k) {
    const ObstacleTerm<D>& term = model_.obstacles[k];
    const PairedFaces faces = paired_faces(nodes_.mesh(), term, model_.t);
    const auto there = couple_sides(nodes_, model_, term, faces.slave, faces.master);
    const auto back = couple_sides(nodes_, model_, term, faces.master, faces.slave);
    facts_[k] = {facts(k, faces.slave, there, back.column), facts(k, faces.master, back, there.column)};
  }

  /// No slave may be where a rigid obstacle acts.
  void look_at_rigid(Index k) {
    const ObstacleTerm<D>& term = model_.obstacles[k];
    const Surface<D> all = term.on ? surface(nodes_, select_faces(nodes_.mesh(), *term.on, model_.t)) : surface(nodes_);
    mark(k, all.nodes);
  }

  /// @param own the coupling with this side as the slave
  /// @param seen vertices of it in the other one
  SideFacts facts(Index k, const std::vector<Index>& faces, const MortarCoupling<D>& own,
                  const std::vector<Index>& seen) {
    SideFacts out;
    for (const std::vector<Index>* vertices : {&own.node, &seen})
      for (const Index v : *vertices) out.nodes.push_back(nodes_.of_vertex(v));
    std::ranges::sort(out.nodes);
    out.nodes.erase(std::unique(out.nodes.begin(), out.nodes.end()), out.nodes.end());
    mark(k, out.nodes);
    out.fixed = prescribed_nodes(nodes_, fixes_, faces, own);
    const std::vector<Index> near = closest(nodes_.mesh(), faces, own, depth);
    double area = 0;
    for (const Index f : near) {
      const Face<D>& face = nodes_.mesh().boundary[f];
      const Point<D> normal = area_normal(nodes_.mesh(), face);
      const double measure = std::sqrt(dot(normal, normal));
      area += measure;
      out.modulus += measure * model_.young(site_in(nodes_.mesh(), static_cast<std::size_t>(face.element), model_.t));
    }
    out.modulus /= area;
    out.size = std::pow(area / static_cast<double>(near.size()), 1.0 / (D - 1));
    return out;
  }

  const std::string& name_of(std::size_t k) const {
    const std::size_t obstacles = model_.obstacles.size();
    return k < obstacles ? model_.obstacles[k].origin : model_.rigid[k - obstacles].on.origin;
  }

  /// Up to two obstacles, or rigid parts after these, per node are kept.
  void mark(Index k, const std::vector<Index>& nodes) {
    for (const Index p : nodes)
      if (first_[p] < 0)
        first_[p] = k;
      else if (first_[p] != k)
        second_[p] = k;
  }

  /// The name of another obstacle that acts on a node of a side.
  std::string taker(const SideFacts& side, Index k) const {
    for (const Index p : side.nodes)
      for (const Index by : {first_[p], second_[p]})
        if (by >= 0 && by != k) return name_of(static_cast<std::size_t>(by));
    return "";
  }

  static std::string softer(const SideFacts& slave, const SideFacts& master) {
    return fmt::format("softer: modulus {:g} beside {:g}", slave.modulus, master.modulus);
  }
  static std::string finer(const SideFacts& slave, const SideFacts& master) {
    return fmt::format("finer: faces of {:.3g} beside {:.3g}, moduli {:g} and {:g}", slave.size, master.size,
                       slave.modulus, master.modulus);
  }

  const Nodes<D>& nodes_;
  const Model<D>& model_;
  const std::vector<FixedDirections<D>> fixes_;
  std::vector<Index> first_, second_;            // per node: obstacles that act on it, -1: none
  std::vector<std::array<SideFacts, 2>> facts_;  // per obstacle
};

}  // namespace

template <int D>
PrescribedNodes prescribed_nodes(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes,
                                 const std::vector<Index>& faces, const MortarCoupling<D>& coupling) {
  PrescribedNodes out;
  std::vector<Index> reached;
  for (const Index f : closest(nodes.mesh(), faces, coupling, within_reach))
    reached.insert(reached.end(), nodes.mesh().boundary[f].vertices.begin(), nodes.mesh().boundary[f].vertices.end());
  std::ranges::sort(reached);
  for (Index n = 0; n < coupling.nodes(); ++n) {
    if (!std::ranges::binary_search(reached, coupling.node[n])) continue;
    ++out.all;
    const Index p = nodes.of_vertex(coupling.node[n]);
    const auto at = std::ranges::lower_bound(fixes, p, {}, &FixedDirections<D>::vertex);
    if (at == fixes.end() || at->vertex != p) continue;
    if (std::all_of(at->fix, at->fix + at->count, [](Index fix) { return fix < 0; })) continue;
    ++out.some;
    out.normal += !free_normal<D>(fixes, p, coupling.normal[n]);
  }
  return out;
}

template <int D>
std::vector<SlaveChoice> choose_slaves(const Nodes<D>& nodes, const Model<D>& model) {
  const auto open = [](const ObstacleTerm<D>& term) { return term.other && term.slave == Slave::automatic; };
  std::vector<SlaveChoice> out;
  for (const ObstacleTerm<D>& term : model.obstacles)
    out.push_back({term.other && term.slave == Slave::other, term.other ? "as the scene says" : ""});
  if (std::ranges::none_of(model.obstacles, open)) return out;
  Chooser<D> chooser(nodes, model);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (open(model.obstacles[k])) out[k] = chooser.choose(static_cast<Index>(k));
  return out;
}

template <int D>
void exchange_sides(const std::vector<SlaveChoice>& choices, Model<D>& model) {
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (choices[k].exchanged) std::swap(model.obstacles[k].on, model.obstacles[k].other);
}

template PrescribedNodes prescribed_nodes(const Nodes<2>&, const std::vector<FixedDirections<2>>&,
                                          const std::vector<Index>&, const MortarCoupling<2>&);
template PrescribedNodes prescribed_nodes(const Nodes<3>&, const std::vector<FixedDirections<3>>&,
                                          const std::vector<Index>&, const MortarCoupling<3>&);
template std::vector<SlaveChoice> choose_slaves(const Nodes<2>&, const Model<2>&);
template std::vector<SlaveChoice> choose_slaves(const Nodes<3>&, const Model<3>&);
template void exchange_sides(const std::vector<SlaveChoice>&, Model<2>&);
template void exchange_sides(const std::vector<SlaveChoice>&, Model<3>&);

}  // namespace signorini
