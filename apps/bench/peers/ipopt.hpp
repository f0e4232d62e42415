#pragma once
#include "apps/bench/peers/instance.hpp"

namespace signorini::bench {

/// IPOPT's interior point method with MUMPS on the matrix and the bounds. Only where IPOPT was found.
Attempt ipopt(const Instance& instance, double tolerance);

}  // namespace signorini::bench
