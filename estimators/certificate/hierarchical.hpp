#pragma once
#include "estimators/estimator.hpp"

namespace signorini {

/// What bubbles of edges win, with obstacles in them and friction with the tractions found (Kornhuber 1996; Zou,
/// Veeser, Kornhuber and Gräser, Hierarchical error estimates for the energy functional in obstacle problems, 2011):
/// the lower bound of certificate(), in a small part of its time.
template <int D, int B>
Estimate hierarchical(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                      const EstimateOptions<B>& options = {});

}  // namespace signorini
