#pragma once

namespace signorini::bench {

/// Matrices of quadratic elements, in the basis whose coefficients are values at nodes, given to the black box: cycles
/// and time beside matrices of linear elements with the same nodes.
void print_quadratic_matrices(bool quick);

}  // namespace signorini::bench
