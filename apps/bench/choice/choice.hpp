#pragma once
#include <string>

namespace signorini::bench {

/// Prints, for every benchmark scene, the time of the default settings over that of the best settings picked by hand.
/// @param only problems with this text in their names
void print_choice(const std::string& only);

/// The same for scenes on which nothing was chosen (kept_aside/), with the settings of kept_aside.hpp.
void print_kept_aside_scenes(const std::string& only);

}  // namespace signorini::bench
