#pragma once
#include <Eigen/Core>

namespace signorini {

/// The point of the cone { c : G c >= 0 } next to g, by nonnegative least squares for its multipliers (Lawson and
/// Hanson, Solving Least Squares Problems, SIAM 1995, ch. 23). G has one row per condition and few columns; rows of
/// length one are compared.
Eigen::VectorXd project_onto_cone(const Eigen::MatrixXd& G, const Eigen::VectorXd& g);

}  // namespace signorini
