#pragma once
#include <string>

namespace signorini::bench {

/// Prints, for every benchmark scene, the time of the default settings over that of the best settings picked by hand.
/// @param only problems with this text in their names
void print_choice(const std::string& only);

}  // namespace signorini::bench
