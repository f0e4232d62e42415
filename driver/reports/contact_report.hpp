#pragma once
#include <vector>

#include "driver/reports/results.hpp"

namespace signorini {

/// Total forces of each obstacle of a model on the bodies that the scene names.
template <int B>
struct ContactForces {
  std::vector<std::array<double, B>> on_body, on_other;
};

template <int D, int B>
ContactForces<B> contact_forces(const Results<D, B>& results);

/// What the obstacles of a body do to it at the step parameter t, in the order of the body's obstacles.
template <int D, int B>
std::vector<ContactReport> contact_reports(const Scene& scene, const Nodes<D>& nodes, const Results<D, B>& results,
                                           double t, std::size_t body);

}  // namespace signorini
