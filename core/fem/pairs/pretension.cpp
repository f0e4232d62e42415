#include "core/fem/pairs/pretension.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/across.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

/// Radians by which faces of one plane may be inclined, as those of a mesh file are by rounding.
constexpr double flat = 1e-3;

/// The cut of one bolt on one mesh.
template <int D>
class BoltCut {
 public:
  BoltCut(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, const std::vector<Index>& slave)
      : nodes_(nodes), mesh_(nodes.mesh()), model_(model), origin_(model.obstacles[obstacle].pretension->origin) {
    for (const Index f : slave) add(normal_, area_normal(mesh_, mesh_.boundary[f]), 1);
    normalise(normal_);
    refuse_bent(slave);
    if (model.plane == Plane::axisymmetric && std::abs(normal_[0]) > flat)
      input_error(origin_,
                  fmt::format("the cut's normal is ({:.4g}), and a body of revolution is pulled along its axis; "
                              "expected faces across the axis, of constant y",
                              fmt::join(normal_, ", ")));
  }

  const Point<D>& normal() const { return normal_; }

  /// Else nodes of the cut would not go along.
  void refuse_fixed(const std::vector<Index>& slave, const std::vector<FixedDirections<D>>& fixes) const {
    for (const Index f : slave)
      for (const Index p : nodes_.of_face(f)) {
        const FixedDirections<D>* fixed = fixed_at(fixes, p);
        for (int k = 0; fixed && k < fixed->count; ++k)
          if (std::abs(block::dot<D>(fixed->direction[k], normal_.data())) > flat) refuse_fixed(p, fixed->fix[k]);
      }
  }

  /// The tied vertex of the coarsest mesh that is nearest to their middle: the same one on all meshes where the master
  /// is in front of it on all. Else another node.
  Index carrier(const std::vector<Index>& slave, const std::map<Index, TieRow<D>>& rows) const {
    const auto is_whole = [&](const TieRow<D>& row) { return std::abs(row.part - 1) <= rounding_of_differences; };
    std::vector<Index> corners;
    for (const Index f : slave) {
      const auto of = coarsest_face(mesh_, f / faces_per_coarsest(mesh_));
      corners.insert(corners.end(), of.begin(), of.end());
    }
    std::ranges::sort(corners, {}, [&](Index v) { return mesh_.points[v]; });
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    Point<D> middle{};
    for (const Index v : corners) add(middle, mesh_.points[v], 1.0 / static_cast<double>(corners.size()));
    std::erase_if(corners, [&](Index v) {
      const auto row = rows.find(nodes_.of_vertex(v));
      return row == rows.end() || !is_whole(row->second);
    });
    if (corners.empty()) {
      const auto any = std::ranges::find_if(rows, [&](const auto& row) { return is_whole(row.second); });
      if (any == rows.end()) refuse_incomplete();
      return any->first;
    }
    const auto off = [&](Index v) { return length<D>(difference<D>(mesh_.points[v], middle)); };
    return nodes_.of_vertex(*std::ranges::min_element(corners, {}, off));
  }

 private:
  static void add(Point<D>& sum, const Point<D>& x, double weight) {
    for (int i = 0; i < D; ++i) sum[i] += weight * x[i];
  }

  void refuse_bent(const std::vector<Index>& slave) const {
    for (const Index f : slave) {
      Point<D> n = area_normal(mesh_, mesh_.boundary[f]);
      normalise(n);
      if (length<D>(difference<D>(n, normal_)) > flat)
        input_error(origin_,
                    fmt::format("the cut is not flat: its normal is ({:.4g}) at ({:.4g}), and ({:.4g}) in the mean; "
                                "expected faces in one plane ('on', 'other_on')",
                                fmt::join(n, ", "), fmt::join(mesh_.points[mesh_.boundary[f].vertices[0]], ", "),
                                fmt::join(normal_, ", ")));
    }
  }

  [[noreturn]] void refuse_fixed(Index p, Index fix) const {
    input_error(
        origin_,
        fmt::format("at ({:.4g}) {} prescribes the displacement across the cut, which the bolt pulls at; "
                    "expected a cut apart from that, or the other body as the slave ('slave')",
                    fmt::join(nodes_.at(p), ", "), fix >= 0 ? model_.fixes[fix].on.origin : "a plane of symmetry"));
  }

  [[noreturn]] void refuse_incomplete() const {
    input_error(origin_,
                "beside each node of the cut is one that is left out of the tie: fixes or obstacles act there, or "
                "the other body is not in front of it; expected smaller elements, or the other body as the "
                "slave ('slave')");
  }

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  const Model<D>& model_;
  const std::string& origin_;
  Point<D> normal_{};
};

template <int D>
std::array<double, D * D> times_projector(double part, const Point<D>& n) {
  std::array<double, D * D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out[i * D + j] = part * n[i] * n[j];
  return out;
}

/// What one of the others sees: the carrier's jump along the normal, too.
template <int D>
BlockRow<D> with_carrier(BlockRow<D> row, Index carrier, const BlockRow<D>& of_carrier,
                         const std::array<double, D * D>& along) {
  for (const auto& [q, W] : of_carrier) {
    double part[D * D];
    block::multiply<D>(along.data(), W.data(), part);
    for (int i = 0; i < D * D; ++i) row[q][i] -= part[i];
  }
  for (int i = 0; i < D * D; ++i) row[carrier][i] += along[i];
  return row;
}

}  // namespace

template <int D>
PretensionedTie<D> pretension(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                              const std::vector<Index>& slave, const std::vector<FixedDirections<D>>& fixes,
                              const std::map<Index, TieRow<D>>& rows, JumpBuilder<D>& jumps) {
  const BoltCut<D> cut(nodes, model, obstacle, slave);
  cut.refuse_fixed(slave, fixes);
  PretensionedTie<D> out{obstacle, cut.carrier(slave, rows), cut.normal()};
  if (!nodes.mesh().mirrors.empty())
    out.copies = 1 << std::popcount(planes_across(nodes, model.obstacles[obstacle].on, model.t));
  jumps.share(out.carrier);
  const BlockRow<D>& of_carrier = rows.at(out.carrier).weights;
  for (const auto& [p, row] : rows)
    if (p != out.carrier)
      jumps.add(p, with_carrier<D>(row.weights, out.carrier, of_carrier, times_projector<D>(row.part, out.normal)));
  return out;
}

template <int D>
void hold_carrier(const PretensionedTie<D>& tie, const Pretension& pretension, FixedDirections<D>& fixed) {
  const int number = fixed.count;
  fixed.add(tie.normal.data(), pretension.locked.value_or(0), by_tie(tie.obstacle));
  fixed.hold_rest(by_tie(tie.obstacle));
  if (pretension.locked) return;
  for (int k = number + 1; k < fixed.count; ++k) {
    std::copy_n(fixed.direction[k], D, fixed.direction[k - 1]);
    fixed.value[k - 1] = fixed.value[k];
    fixed.fix[k - 1] = fixed.fix[k];
  }
  --fixed.count;
}

template <int D>
double pull(const PretensionedTie<D>& tie, const Model<D>& model) {
  const Pretension& pretension = *model.obstacles[tie.obstacle].pretension;
  if (pretension.locked) return 0;
  return pretension.force(site<D>(Point<D>{}, model.t)) / tie.copies;
}

template <int D>
void add_pretension(const Model<D>& model, const PairedBodies<D>& pairs, std::vector<double>& load) {
  if (pairs.pretensioned.empty()) return;
  std::vector<double> forces(load.size());
  for (const PretensionedTie<D>& tie : pairs.pretensioned)
    for (int i = 0; i < D; ++i) forces[Offset{tie.carrier} * D + i] += pull(tie, model) * tie.normal[i];
  transform_forces_back(*pairs.jumps, forces);
  for (std::size_t k = 0; k < load.size(); ++k) load[k] += forces[k];
}

#define SIGNORINI_INSTANTIATE(D)                                                                                    \
  template PretensionedTie<D> pretension(const Nodes<D>&, const Model<D>&, Index, const std::vector<Index>&,        \
                                         const std::vector<FixedDirections<D>>&, const std::map<Index, TieRow<D>>&, \
                                         JumpBuilder<D>&);                                                          \
  template void hold_carrier(const PretensionedTie<D>&, const Pretension&, FixedDirections<D>&);                    \
  template double pull(const PretensionedTie<D>&, const Model<D>&);                                                 \
  template void add_pretension(const Model<D>&, const PairedBodies<D>&, std::vector<double>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
