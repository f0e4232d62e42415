#pragma once
#include <string>
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/mortar/couple.hpp"

namespace signorini {

/// Which of the two bodies of an obstacle is the slave, and why.
struct SlaveChoice {
  bool exchanged = false;  ///< the second one, ObstacleTerm::other
  std::string reason;      ///< a few words: "softer: modulus 1 beside 100"
};

/// Nodes of a slave where fixes (not planes of symmetry) stand in the way of contact with the other body.
struct PrescribedNodes {
  Index all = 0;     ///< that have a part of the other body in front of them, and where contact may come to
  Index normal = 0;  ///< prescribed along the normal: left out, nothing keeps the other body off them
  Index some = 0;    ///< prescribed along any direction: no friction acts along that

  /// Friction is lost at most nodes.
  bool without_friction() const { return 2 * some > all; }
};
/// Contact may come to faces that are by no more than their length farther apart than the closest ones.
/// @param faces the slave's
template <int D>
PrescribedNodes prescribed_nodes(const Nodes<D>& nodes, const std::vector<FixedDirections<D>>& fixes,
                                 const std::vector<Index>& faces, const MortarCoupling<D>& coupling);

/// One per obstacle of the model; of those that act on one body the reason is empty. Where the model leaves it open the
/// slave is the softer body, by the moduli next to the faces that are closest to the other body; where they differ by
/// less than a factor of 2 the one with the smaller faces there; where these are alike what there is of such
/// differences decides, and without any it is the first one. A side is no slave as long as the other one may be where
/// all of it is prescribed along its normals, or where another obstacle acts on some of its nodes: these may be masters
/// only; and where some of it is prescribed along the normals, or most of it along the surface with friction, and
/// nothing of the other one, which is not far stiffer. Error(Exit::input) as couple() and select_faces() have them.
/// @param nodes of the coarsest mesh: finer ones have the same ratios
template <int D>
std::vector<SlaveChoice> choose_slaves(const Nodes<D>& nodes, const Model<D>& model);

/// Makes the slave's faces those of ObstacleTerm::on.
template <int D>
void exchange_sides(const std::vector<SlaveChoice>& choices, Model<D>& model);

}  // namespace signorini
