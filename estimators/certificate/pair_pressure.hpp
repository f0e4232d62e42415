#pragma once
#include "estimators/certificate/contact_forces.hpp"
#include "estimators/certificate/vertex_forces.hpp"

namespace signorini {

/// What bodies that may touch exert on each other: on each interface a pressure p >= 0, and a traction along it that is
/// at most what friction allows. Both are linear on the faces of the slave, where the master covers them, and the
/// opposite traction acts on the master. What of it is not linear on a face is not in `forces`; Contact::oscillation
/// pays for it.
template <int D>
void press_between(const TrueProblem<D, D>& problem, const AtVertices<D, D>& at, const Bubbles<D, D>& bubbles,
                   Contact<D, D>& out);

}  // namespace signorini
