#pragma once

namespace signorini::bench {

/// Prints, for every benchmark scene, the time of the default settings over that of the best settings picked by hand.
void print_choice();

}  // namespace signorini::bench
