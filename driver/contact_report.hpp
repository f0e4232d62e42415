#pragma once
#include <vector>

#include "driver/results.hpp"

namespace signorini {

/// What the obstacles of a body do to it at the step parameter t, in the order of the body's obstacles.
template <int D, int B>
std::vector<ContactReport> contact_reports(const Scene& scene, const Nodes<D>& nodes, const Results<D, B>& results,
                                           double t, std::size_t body);

}  // namespace signorini
