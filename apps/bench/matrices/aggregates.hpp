#pragma once

namespace signorini::bench {

/// Greedy aggregates and those of METIS, on meshes that are not refined.
void print_aggregates();

}  // namespace signorini::bench
