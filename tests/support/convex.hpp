#pragma once
#include <Eigen/Cholesky>
#include <functional>

#include "tests/support/dense.hpp"

/// An independent solver for min 1/2 x'Ax - b'x + phi(x): it knows no sweeps, levels or scalar product of A.
namespace signorini::test {

/// Alternating direction method of multipliers (Boyd et al., Foundations and Trends in Machine Learning 3, 2011).
/// @param prox prox(rho, z): the minimiser of rho/2 |y - z|^2 + phi(y), in place
/// @return the admissible y, x - y being at most `tolerance` in size
inline Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                        const std::function<void(double, Eigen::VectorXd&)>& prox,
                                        double tolerance = 1e-12) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(A, Eigen::EigenvaluesOnly);
  const double rho = std::sqrt(spectrum.eigenvalues().maxCoeff() * std::max(spectrum.eigenvalues().minCoeff(), 1e-3));
  const Eigen::LLT<Eigen::MatrixXd> factor(A + rho * Eigen::MatrixXd::Identity(A.rows(), A.cols()));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size()), y = x, u = x;
  for (int k = 0; k < 200000; ++k) {
    x = factor.solve(b + rho * (y - u));
    const Eigen::VectorXd last = y;
    y = x + u;
    prox(rho, y);
    u += x - y;
    const double size = 1e-300 + y.cwiseAbs().maxCoeff();
    if ((x - y).cwiseAbs().maxCoeff() <= tolerance * size && (y - last).cwiseAbs().maxCoeff() <= tolerance * size)
      break;
  }
  return y;
}

/// The same for phi(Kx) with a matrix K of full column rank: prox(rho, z) for the variables Kx. Returns x; nothing
/// where it converges too slowly.
inline Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::MatrixXd& K,
                                        const std::function<void(double, Eigen::VectorXd&)>& prox,
                                        double tolerance = 1e-12) {
  const double rho = std::sqrt(A.operatorNorm());
  const Eigen::LLT<Eigen::MatrixXd> factor(A + rho * K.transpose() * K);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size()), y = Eigen::VectorXd::Zero(K.rows()), u = y;
  for (int k = 0; k < 40000; ++k) {
    x = factor.solve(b + rho * K.transpose() * (y - u));
    const Eigen::VectorXd last = y, Kx = K * x;
    y = Kx + u;
    prox(rho, y);
    u += Kx - y;
    const double size = 1e-300 + y.cwiseAbs().maxCoeff();
    if ((Kx - y).cwiseAbs().maxCoeff() <= tolerance * size && (y - last).cwiseAbs().maxCoeff() <= tolerance * size)
      return x;
  }
  return {};
}

}  // namespace signorini::test
