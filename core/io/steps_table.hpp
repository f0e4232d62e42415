#pragma once
#include <string>

#include "core/io/report.hpp"

namespace signorini {

/// Forces and displacements over the steps as comma-separated values in full precision, with a heading: a line per step
/// and obstacle, see docs/results.md, "steps.csv". Numbers that are not known are left out.
std::string steps_csv(const Report& report);

}  // namespace signorini
