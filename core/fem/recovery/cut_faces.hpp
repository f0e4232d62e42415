#pragma once
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// A selection whose expression cuts through faces of the coarsest mesh, which are picked as a whole or not at all.
struct CutSelection {
  const Selection* selection;  ///< of the model
  double picked;               ///< measure of the faces picked
  double wrong;                ///< of the parts of these on which the expression does not hold, by sampling
  double missed;               ///< of what the expression holds on besides, by sampling
};

/// Those of a model's fixes, loads and obstacles. The faces must be picked already: see select_faces(). Faces that
/// stand for a curved surface which the mesh does not know are never wrong: an expression may hold on that surface
/// alone. Nor is a strip missed that is all of its smooth piece of the boundary on which the expression holds, where it
/// is as narrow as tolerances in expressions are.
/// @param mesh any of the hierarchy; faces are those of the coarsest one
template <int D, int B>
std::vector<CutSelection> cut_selections(const Mesh<D>& mesh, const Model<B>& model);

}  // namespace signorini
