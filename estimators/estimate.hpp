#pragma once
#include <vector>

#include "core/io/estimate_report.hpp"

namespace signorini {

/// What an estimator says of a finite element function: bounds of J(v) - J(u), and where that comes from.
struct Estimate : EstimateReport {
  std::vector<double> of_element;  ///< shares of the upper bound, of each element of Nodes
  double imbalance = 0;            ///< the largest force that is missing in an element, see largest_imbalance()
  bool solve_failed = false;  ///< EstimateOptions::solve did: the upper bound holds, but is larger than it might be
};

}  // namespace signorini
