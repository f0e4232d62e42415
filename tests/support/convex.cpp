#include "tests/support/convex.hpp"
#include "core/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace signorini::test {

Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                 const std::function<void(double, Eigen::VectorXd&)>& prox, double tolerance) {
  const Eigen::VectorXd spectrum = eigenpairs(A).values;
  const double rho = std::sqrt(spectrum.maxCoeff() * std::max(spectrum.minCoeff(), 1e-3));
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

Eigen::VectorXd convex_minimiser(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::MatrixXd& K,
                                 const std::function<void(double, Eigen::VectorXd&)>& prox, double tolerance) {
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
