#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/solver/components.hpp"

namespace signorini {

/// Moves the finest level's x along motions of the coarsest level that have no energy, one after the other, each to
/// where the functionals end the fall. A body that little friction holds needs this: as long as all of it slips nothing
/// holds its linear model.
/// @param motions one per column, B rows per vector of the coarsest level
template <int B>
void slide(std::vector<Level<B>>& levels, const std::vector<std::unique_ptr<Transfer<B>>>& transfers,
           const Eigen::MatrixXd& motions);

}  // namespace signorini
