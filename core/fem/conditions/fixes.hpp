#pragma once
#include "core/constraints/fixed_directions.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// Stands in FixedDirections::fix for the tie that is one of a model's obstacles.
constexpr Index by_tie(Index obstacle) { return -2 - 2 * obstacle; }
/// The same for a rigid part.
constexpr Index by_rigid_part(Index part) { return -3 - 2 * part; }

/// Two conditions that contradict each other.
struct FixConflict {
  Index earlier, later;  ///< numbers in Model::fixes; the later one holds
  Index vertices;        ///< at so many of them
};

/// All Dirichlet conditions of a model, per node, ascending. Where conditions contradict each other in a direction,
/// the later [[fix]] holds. In a normal frame the components are those along the outer normal, averaged over the picked
/// faces around the vertex, and along the tangents (see tangents()); where these faces fall into groups whose normals
/// differ by more than 30 degrees (and that do not lie on one curve), the condition holds along each group's normal. In
/// a cylindrical one see directions(). On the axis of an axisymmetric elastic body, r = 0, the radial displacement is
/// zero, and on planes of symmetry the one across them; Error(Exit::input) where a fix prescribes another one.
template <int D, int B>
std::vector<FixedDirections<B>> collect_fixes(const Nodes<D>& nodes, const Model<B>& model);

template <int D, int B>
std::vector<FixConflict> fix_conflicts(const Nodes<D>& nodes, const Model<B>& model);

}  // namespace signorini
