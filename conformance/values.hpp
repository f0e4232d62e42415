#pragma once
#include <string>
#include <vector>

#include "conformance/subject.hpp"

namespace signorini::conformance {

/// A value within the range of an option, "gap=0.3"; "" where none is known, as for texts that are no choice.
/// @param number tells options of the same range apart
std::string value_within(const OptionSpec& option, int dimension, int number);

/// Values at the ends of its range, or all that it may be; large ones where there is no end.
Values values_at_ends(const OptionSpec& option, int dimension);

}  // namespace signorini::conformance
