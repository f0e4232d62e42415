#pragma once
#include <Eigen/Core>
#include <memory>

/// Decompositions of small dense matrices, behind functions: they are instantiated once, for Eigen's templates of them
/// take compilers longer than whole files of ours.
namespace signorini {

/// A symmetric matrix is vectors * diag(values) * vectors^T; the values ascend.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// No numbers where the matrix has entries that are none.
Eigenpairs eigenpairs(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);

/// A symmetric matrix as L D L^T, with pivots.
class SymmetricFactors {
 public:
  explicit SymmetricFactors(const Eigen::Ref<const Eigen::MatrixXd>& H);
  Eigen::VectorXd pivots() const;  ///< D
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> factors_;
};

/// H = L L^T, for a definite H.
Eigen::MatrixXd cholesky(const Eigen::Ref<const Eigen::MatrixXd>& H);

/// Orthonormal columns that span those of a matrix with full rank, as many.
Eigen::MatrixXd orthonormal_columns(const Eigen::Ref<const Eigen::MatrixXd>& A);
/// R of A = Q R, for at least as many rows as columns.
Eigen::MatrixXd triangular_factor(const Eigen::Ref<const Eigen::MatrixXd>& A);

/// In descending order.
Eigen::VectorXd singular_values(const Eigen::Ref<const Eigen::MatrixXd>& A);

/// Orthonormal columns that span what all rows map to zero.
/// @param tolerance part of the largest singular value below which one counts as zero
Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows, double tolerance);

/// The nearest A x to b, by QR with pivots, and what the factors tell besides.
struct LeastSquares {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;
  Eigen::MatrixXd range;  ///< orthonormal columns that span those of A
};
/// @param threshold part of the largest pivot below which one counts as zero; 0: as rounding lets expect
LeastSquares least_squares(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& b,
                           double threshold = 0);

/// Of all x with the nearest A x to b the shortest.
Eigen::VectorXd smallest_solution(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                  const Eigen::Ref<const Eigen::VectorXd>& b);

}  // namespace signorini
