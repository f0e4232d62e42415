#pragma once

namespace signorini::bench {

/// Matrices and bounds without any mesh: the black box against linear conjugate gradients on the same algebraic levels,
/// and against the geometric hierarchy, as a table.
/// @param quick leaves out the largest sizes
void print_algebraic(bool quick);

}  // namespace signorini::bench
