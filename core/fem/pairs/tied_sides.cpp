#include "core/fem/pairs/tied_sides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

/// Of the longest edge that faces have on the coarsest mesh: two meshes of one curved surface may be so far apart.
constexpr double touching = 0.02;
/// Weights of less than this are rounding, and so is this part of a displacement.
constexpr double seen_least = 1e-9;

/// Whether fixes prescribe all that a node sees of the master to go along with it, where they prescribe something of
/// it.
template <int D>
bool goes_along(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes, const MortarCoupling<D>& coupling,
                Index k, const FixedDirections<D>& fixed) {
  for (int i = 0; i < fixed.count; ++i) {
    if (fixed.fix[i] < 0) continue;  // a plane of symmetry, along which nothing pulls across it
    double there = 0, size = std::abs(fixed.value[i]);
    for (Offset j = coupling.row[k]; j < coupling.row[k + 1]; ++j) {
      if (std::abs(coupling.value[j]) <= seen_least) continue;
      const auto value = prescribed_along(fixes, nodes.of_vertex(coupling.column[j]), fixed.direction[i]);
      if (!value) return false;
      there += coupling.value[j] * *value;
      size = std::max(size, std::abs(*value));
    }
    if (std::abs(there - fixed.value[i]) > seen_least * size) return false;
  }
  return true;
}

/// The slave's vertices where a fix prescribes something that the master is not prescribed to go along with: what they
/// would carry is their neighbours'.
template <int D>
std::vector<Index> held_alone(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes,
                              const MortarCoupling<D>& coupling) {
  std::vector<Index> out;
  for (Index k = 0; k < coupling.nodes(); ++k) {
    const FixedDirections<D>* fixed = fixed_at(fixes, nodes.of_vertex(coupling.node[k]));
    if (fixed && !goes_along(nodes, fixes, coupling, k, *fixed)) out.push_back(coupling.node[k]);
  }
  return out;
}

template <int D>
void refuse_gap(const Nodes<D>& nodes, const ObstacleTerm<D>& term, const MortarCoupling<D>& coupling,
                const std::vector<Index>& slave) {
  const WidestGap<D> gap = widest_gap(nodes, coupling, slave);
  const double largest = gap.touching / touching;
  if (*term.tied > largest)
    input_error(term.origin, fmt::format("adjust is {:.4g}, more than the longest edge of the slave's faces on the "
                                         "coarsest mesh, {:.4g}; expected bodies that nearly touch",
                                         *term.tied, largest));
  if (gap.width <= std::max(gap.touching, *term.tied)) return;
  input_error(term.origin,
              fmt::format("the bodies are {:.4g} apart, or into each other, at ({:.6g}) at the start, and what is tied "
                          "has to touch; expected faces that lie on each other, or 'adjust', the largest distance that "
                          "is passed over",
                          gap.width, fmt::join(gap.place, ", ")));
}

}  // namespace

template <int D>
WidestGap<D> widest_gap(const Nodes<D>& nodes, const MortarCoupling<D>& coupling, const std::vector<Index>& slave) {
  const Mesh<D>& mesh = nodes.mesh();
  WidestGap<D> out;
  for (const Index f : slave) out.touching = std::max(out.touching, longest_edge(mesh, mesh.boundary[f]));
  out.touching = touching * std::ldexp(out.touching, mesh.refinements);
  for (Index k = 0; k < coupling.nodes(); ++k) {
    const double width = std::abs(coupling.distance(k));
    if (width > out.width) out.width = width, out.place = mesh.points[coupling.node[k]];
  }
  return out;
}

template <int D>
MortarCoupling<D> couple_tied(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                              const PairedFaces& faces, const std::vector<FixedDirections<D>>& fixes,
                              const std::vector<Index>& taken) {
  std::vector<Index> left_out = of_other_obstacles(nodes.mesh(), model);
  left_out.insert(left_out.end(), taken.begin(), taken.end());
  const std::vector<Index> alone =
      held_alone<D>(nodes, fixes, couple_sides<D>(nodes, model, term, faces.slave, faces.master));
  left_out.insert(left_out.end(), alone.begin(), alone.end());
  std::ranges::sort(left_out);
  left_out.erase(std::unique(left_out.begin(), left_out.end()), left_out.end());
  MortarCoupling<D> found = couple_beside<D>(nodes, model, term, faces, {}, left_out);
  refuse_gap(nodes, term, found, faces.slave);
  return found;
}

#define SIGNORINI_INSTANTIATE(D)                                                                                       \
  template WidestGap<D> widest_gap(const Nodes<D>&, const MortarCoupling<D>&, const std::vector<Index>&);              \
  template MortarCoupling<D> couple_tied(const Nodes<D>&, const Model<D>&, const ObstacleTerm<D>&, const PairedFaces&, \
                                         const std::vector<FixedDirections<D>>&, const std::vector<Index>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
