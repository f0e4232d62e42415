#pragma once
#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/cgal/sizing.hpp"

namespace signorini::geometry {

/// Throws ShapeError where creases of the domain are so close to each other that they need very many more edges than
/// the size asks for. Call it when the elements to be expected are known.
void check_crease_spacing(const Domain& domain, const Sizing<3>& sizing);

}  // namespace signorini::geometry
