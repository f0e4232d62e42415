#pragma once
#include <Eigen/Core>
#include <functional>

#include "tests/support/dense.hpp"

/// An independent solver for min 1/2 x'Ax - b'x + phi(x): it knows no sweeps, levels or scalar product of A.
namespace signorini::test {

/// Alternating direction method of multipliers (Boyd et al., Foundations and Trends in Machine Learning 3, 2011).
/// @param prox prox(rho, z): the minimiser of rho/2 |y - z|^2 + phi(y), in place
/// @return the admissible y, x - y being at most `tolerance` in size
Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                 const std::function<void(double, Eigen::VectorXd&)>& prox, double tolerance = 1e-12);

/// The same for phi(Kx) with a matrix K of full column rank: prox(rho, z) for the variables Kx. Returns x; nothing
/// where it converges too slowly.
Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::MatrixXd& K,
                                 const std::function<void(double, Eigen::VectorXd&)>& prox, double tolerance = 1e-12);

}  // namespace signorini::test
