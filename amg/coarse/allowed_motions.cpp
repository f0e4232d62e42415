#include "amg/coarse/allowed_motions.hpp"

#include "core/base/cone_projection.hpp"
#include "core/base/types.hpp"

namespace signorini {

void AllowedMotions::bound(const Row& row, double lower, double upper) {
  const double length = row.norm();
  if (lower > -infinity) add(row, 1 / length);
  if (upper < infinity) add(row, -1 / length);
}

void AllowedMotions::add(const Row& row, double factor) {
  for (const double component : row) rows_.push_back(factor * component);
}

Eigen::VectorXd AllowedMotions::nearest(const Eigen::VectorXd& work) const {
  return project_onto_cone(conditions(), work);
}

double AllowedMotions::least_rate(const Eigen::VectorXd& c) const {
  return all() ? infinity : (conditions() * c).minCoeff();
}

auto AllowedMotions::conditions() const -> Eigen::Map<const Matrix> {
  return {rows_.data(), static_cast<Eigen::Index>(rows_.size()) / coordinates_, coordinates_};
}

}  // namespace signorini
