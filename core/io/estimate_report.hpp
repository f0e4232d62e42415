#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace signorini {

/// What the upper bound of an error consists of; the sum is that bound. NaN: not known.
struct EstimateParts {
  double discretisation = 0, algebra = 0, contact = 0, oscillation = 0, geometry = 0, friction = 0;
};

/// A number that a mesh was refined for.
struct GoalReport {
  std::string name;  ///< as the scene has it: "force"
  double value = 0;
  double error = 0;  ///< about how far off it is; NaN: not known

  double relative_error() const { return std::abs(error) / std::abs(value); }
};

/// How much energy v has above the true solution u, J(v) - J(u), from below and from above; v is the discrete solution
/// u_h, moved to the right side of obstacles between nodes. NaN: not known.
struct EstimateReport {
  double lower = 0, upper = 0;
  double estimated = 0;  ///< what meshes are refined by: the upper bound, or of estimators without one what they find
  double total = 0;      ///< J(v): J(u) is at least total - upper, and at most total - lower
  double lifted = 0;     ///< J(v) - J(u_h)
  double energy = 0;     ///< of deformation, 1/2 a(v, v)
  bool guaranteed = false;
  std::vector<std::string> reasons;  ///< why not
  EstimateParts parts;
  std::optional<GoalReport> goal{};  ///< nothing: refined for the energy, or not at all
  double seconds = 0;

  double relative_lower() const { return lower / energy; }
  double relative_upper() const { return upper / energy; }
  double relative_estimated() const { return estimated / energy; }
};

}  // namespace signorini
