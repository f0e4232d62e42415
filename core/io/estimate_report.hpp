#pragma once
#include <string>
#include <vector>

namespace signorini {

/// What the upper bound of an error consists of; the sum is that bound. NaN: not known.
struct EstimateParts {
  double discretisation = 0, algebra = 0, contact = 0, oscillation = 0, geometry = 0, friction = 0;
};

/// How much energy a solution has above the true one, J(v) - J(u), from below and from above. NaN: not known.
struct EstimateReport {
  double lower = 0, upper = 0;
  double energy = 0;  ///< of deformation, 1/2 a(v, v)
  bool guaranteed = false;
  std::vector<std::string> reasons;  ///< why not
  EstimateParts parts;
  double seconds = 0;

  double relative_lower() const { return lower / energy; }
  double relative_upper() const { return upper / energy; }
};

}  // namespace signorini
