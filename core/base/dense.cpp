#include "core/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>

namespace signorini {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix = Eigen::Ref<const MatrixXd>;

Eigenpairs eigenpairs(const Matrix& symmetric) {
  const Eigen::Index n = symmetric.rows();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!symmetric.allFinite()) return {VectorXd::Constant(n, none), MatrixXd::Constant(n, n, none)};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricFactors::SymmetricFactors(const Matrix& H) : factors_(std::make_shared<Eigen::LDLT<MatrixXd>>(H)) {}
VectorXd SymmetricFactors::pivots() const { return factors_->vectorD(); }
MatrixXd SymmetricFactors::solve(const Matrix& b) const { return factors_->solve(b); }

MatrixXd cholesky(const Matrix& H) { return Eigen::LLT<MatrixXd>(H).matrixL(); }

MatrixXd orthonormal_columns(const Matrix& A) {
  return Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), A.cols());
}

MatrixXd triangular_factor(const Matrix& A) {
  return Eigen::HouseholderQR<MatrixXd>(A).matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

// One kind of it, for each takes seconds to compile.
using Svd = Eigen::JacobiSVD<MatrixXd, Eigen::FullPivHouseholderQRPreconditioner>;

VectorXd singular_values(const Matrix& A) { return Svd(A).singularValues(); }

MatrixXd null_space(const MatrixXd& rows, double tolerance) {
  const Eigen::Index n = rows.cols();
  if (rows.rows() == 0 || n == 0) return MatrixXd::Identity(n, n);
  const Svd svd(rows, Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  const Eigen::Index rank = values[0] > 0 ? (values.array() > tolerance * values[0]).count() : 0;
  return svd.matrixV().rightCols(n - rank);
}

LeastSquares least_squares(const Matrix& A, const Eigen::Ref<const VectorXd>& b, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  if (threshold > 0) qr.setThreshold(threshold);
  return {qr.solve(b), qr.rank(), qr.householderQ() * MatrixXd::Identity(A.rows(), qr.rank())};
}

VectorXd smallest_solution(const Matrix& A, const Eigen::Ref<const VectorXd>& b) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(A).solve(b);
}

}  // namespace signorini
