#pragma once

namespace signorini::bench {

/// Plates and beams above an obstacle, and programmes of CUTEst by their formulas, given to the black box: cycles with
/// levels of fourth order, and with those that serve the second order.
void print_fourth_order(bool quick);

}  // namespace signorini::bench
