#pragma once

namespace signorini::bench {

/// What the plugin boundary costs, as a table: the scalar plugin's sweep over the same loop written by hand, and the
/// contact plugin's over a sweep of the linear problem.
/// @param quick leaves out the largest sizes
void print_boundary(bool quick);

}  // namespace signorini::bench
