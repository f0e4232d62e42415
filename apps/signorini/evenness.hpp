#pragma once
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Whether a body and all that acts on it lie on both sides of a plane alike: odd moments of the boundary and of what
/// each condition picks vanish. Where faces are curved, what is picked is even up to two hundredths, as meshes leave
/// it. What values they have there is left to check_symmetry().
/// @param any_shape the body may be of any shape; else it is one that is even about its middle
template <int D, int B>
bool is_even(const Mesh<D>& whole, const Model<B>& model, const Mirror& plane, bool any_shape);

}  // namespace signorini
