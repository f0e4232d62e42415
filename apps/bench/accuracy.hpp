#pragma once

namespace signorini::bench {

/// Errors of force, largest pressure and radius beside the seconds they take, linear and quadratic elements, and
/// CalculiX where its program ccx is there: the tables of docs/accuracy.md.
void print_accuracy(bool quick);

}  // namespace signorini::bench
