#pragma once
#include <vector>

#include "core/io/estimate_report.hpp"

namespace signorini {

/// What an estimator says of a finite element function: bounds of J(v) - J(u), and where that comes from.
struct Estimate : EstimateReport {
  std::vector<double> of_element;  ///< shares of the upper bound, of each element of Nodes
  double lifted = 0;     ///< J(v) - J(u_h), where the discrete solution u_h had to be made admissible to get v
  double imbalance = 0;  ///< the largest force that is missing in an element, see largest_imbalance()
};

}  // namespace signorini
