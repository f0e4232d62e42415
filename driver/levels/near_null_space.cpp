#include "driver/levels/near_null_space.hpp"

#include <algorithm>
#include <vector>

#include "core/mesh/connected.hpp"

namespace signorini {
namespace {

/// Per node the body that it is in.
template <int D>
std::vector<Index> bodies(const Nodes<D>& nodes) {
  const std::vector<Index> part = connected_parts(nodes.mesh());
  std::vector<Index> out(static_cast<std::size_t>(nodes.size()), 0);
  for (auto v = static_cast<Index>(part.size()) - 1; v >= 0; --v) out[nodes.of_vertex(v)] = part[v];
  return out;
}

/// Unknowns that are the motion of a rigid part, or common to many nodes, are no displacements: each is a part of its
/// own, which coarse levels keep.
template <int B>
void isolate_motions(const Jumps<B>& jumps, std::vector<Index>& part) {
  const BlockRows<B>& rows = jumps.basis;
  for (Index k = 0; k < jumps.size(); ++k)
    for (Offset j = rows.row[k]; j < rows.row[k + 1] && jumps.given[k]; ++j)
      if (rows.column[j] != jumps.vector[k]) part[rows.column[j]] = -1 - rows.column[j];
  for (const Index p : jumps.common) part[p] = -1 - p;
}

/// Each body moves by itself, for no more than contact couples it to others. In terms of unknowns a slave that moves
/// alone has its motion at all its nodes, and with its master none on the side that faces it: either is made of the
/// motion of the body and of that of the side, which is a part of its own for each master.
template <int D, int B>
std::vector<Index> parts(const Nodes<D>& nodes, const Jumps<B>& jumps) {
  const std::vector<Index> body = bodies(nodes);
  const Index many = std::ranges::max(body) + 1;
  std::vector<Index> out = body;
  const BlockRows<B>& rows = jumps.inverse;
  isolate_motions(jumps, out);
  const auto is_common = [&](Index p) { return std::ranges::find(jumps.common, p) != jumps.common.end(); };
  for (Index k = 0; k < jumps.size(); ++k) {
    const Index p = jumps.vector[k];
    if (jumps.given[k]) continue;
    for (Offset j = rows.row[k]; j < rows.row[k + 1] && out[p] == body[p]; ++j)
      if (rows.column[j] != p && !is_common(rows.column[j])) out[p] += many * (1 + body[rows.column[j]]);
  }
  return out;
}

}  // namespace

template <int D, int B>
NearNullSpace near_null_space(const Nodes<D>& nodes, const Jumps<B>* jumps) {
  if constexpr (B == 1) return {};
  std::vector<double> coordinates;
  for (Index p = 0; p < nodes.size(); ++p) {
    const Point<D> x = nodes.control_point(p);
    coordinates.insert(coordinates.end(), x.begin(), x.end());
  }
  NearNullSpace space = rigid_body_modes<D>(coordinates);
  if constexpr (D == B)
    if (jumps && jumps->size() > 0) space.part = parts(nodes, *jumps);
  return space;
}

template NearNullSpace near_null_space<2, 1>(const Nodes<2>&, const Jumps<1>*);
template NearNullSpace near_null_space<2, 2>(const Nodes<2>&, const Jumps<2>*);
template NearNullSpace near_null_space<3, 1>(const Nodes<3>&, const Jumps<1>*);
template NearNullSpace near_null_space<3, 3>(const Nodes<3>&, const Jumps<3>*);

}  // namespace signorini
