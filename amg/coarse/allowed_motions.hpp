#pragma once
#include <Eigen/Core>
#include <vector>

namespace signorini {

/// The motions, in coordinates c of a few of them, that no bound ends however far they go: the cone of all c along
/// which what has a lower bound does not fall, and what has an upper one does not rise.
class AllowedMotions {
 public:
  using Row = Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

  explicit AllowedMotions(Eigen::Index coordinates) : coordinates_(coordinates) {}

  /// An unknown that moves by row . c, row not zero, between bounds that may be infinite.
  void bound(const Row& row, double lower, double upper);

  /// No bound ends any.
  bool all() const { return rows_.empty(); }

  /// The allowed motion next to `work`, what the forces do along each coordinate. Where it is not zero, but for
  /// rounding, they do work along it for ever.
  Eigen::VectorXd nearest(const Eigen::VectorXd& work) const;

  /// Least rate at which an unknown goes away from its bound along c, rows of length one; negative where it meets it,
  /// infinite without bounds.
  double least_rate(const Eigen::VectorXd& c) const;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void add(const Row& row, double factor);
  Eigen::Map<const Matrix> conditions() const;

  Eigen::Index coordinates_;
  std::vector<double> rows_;  // of length one, one after the other: row . c >= 0
};

}  // namespace signorini
