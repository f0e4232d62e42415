#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Part of the elements that are stretched: whose longest edge over the root of their measure is more than `limit`
/// times that of a right-angled corner of a cube. Cells stretched a times in one direction count where the square root
/// of a (D = 2) or its power 2/3 (D = 3) is larger than about 1.4 times the limit, flat ones (D = 3) where its cube
/// root is.
template <int D>
double stretched_part(const Mesh<D>& mesh, double limit);

}  // namespace signorini
