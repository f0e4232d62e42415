#pragma once
#include <Eigen/Core>
#include <vector>

namespace signorini {

/// lower <= row . c <= upper
struct Slab {
  Eigen::RowVectorXd row;
  double lower, upper;
};

/// Rows as a matrix of so many columns.
Eigen::MatrixXd stacked(const std::vector<Eigen::RowVectorXd>& rows, Eigen::Index columns);

/// The point within all slabs that is next to `wanted`, at about the distance `far`; zero where there is none, or
/// rounding does not let it be found.
Eigen::VectorXd nearest(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs, double far);

/// The same where zero is within all slabs.
Eigen::VectorXd within(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs);

/// The same without what the search loses of digits that the rows have, for a stiff body would have large forces from
/// that: along sides that zero is next to, the point stays as far off them as zero is, and it is taken back towards
/// zero where it violates others.
Eigen::VectorXd exactly_within(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs);

}  // namespace signorini
