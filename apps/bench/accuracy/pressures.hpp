#pragma once

namespace signorini::bench {

/// Recoveries of the contact pressure from nodal forces beside Hertz, and the axisymmetric ball beside the one in
/// space: the tables of docs/measured/pressures.md.
void print_pressures(bool quick);

}  // namespace signorini::bench
