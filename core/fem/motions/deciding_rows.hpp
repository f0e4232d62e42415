#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "core/base/dense.hpp"
#include "core/base/rounding.hpp"

namespace signorini {

/// Rows, of which only what decides their null space is kept.
class DecidingRows {
 public:
  explicit DecidingRows(int columns) : columns_(columns), rows_(std::max(capacity, 2 * columns), columns) {}

  void add(const Eigen::RowVectorXd& row) {
    rows_.row(used_++) = row;
    if (used_ == rows_.rows()) compress();
  }

  /// Whether they surely are linearly independent in all columns.
  bool complete() const { return complete_; }

  // part of the largest one below which a singular value is zero
  Eigen::MatrixXd null_space() const { return signorini::null_space(rows_.topRows(used_), rounding_of_bases); }

 private:
  static constexpr int capacity = 64;
  static constexpr double surely = 1e-6;

  void compress() {
    const Eigen::MatrixXd R = triangular_factor(rows_);
    rows_.topRows(columns_) = R;
    used_ = columns_;
    const Eigen::VectorXd values = singular_values(R);
    complete_ = values[columns_ - 1] > surely * values[0];
  }

  int columns_;
  Eigen::MatrixXd rows_;
  Eigen::Index used_ = 0;
  bool complete_ = false;
};

}  // namespace signorini
