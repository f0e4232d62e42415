#include "driver/motions/slabs.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/cone_projection.hpp"
#include "core/base/dense.hpp"
#include "core/base/types.hpp"

namespace signorini {
namespace {

constexpr double decided = 1e-8;  // of the way: what projections onto cones are known to

/// The point next to zero of { v : G v >= h }, which is not empty (Lawson and Hanson, Solving Least Squares Problems,
/// SIAM 1995, ch. 23): from the projection of (0, 1) onto the cone over it.
Eigen::VectorXd least_point(const Eigen::MatrixXd& G, const Eigen::VectorXd& h) {
  const Eigen::Index n = G.cols();
  if (G.rows() == 0) return Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd cone(G.rows(), n + 1);
  cone << G, -h;
  const Eigen::VectorXd p = project_onto_cone(cone.rowwise().normalized(), Eigen::VectorXd::Unit(n + 1, n));
  return p.head(n) / p[n];
}

}  // namespace

Eigen::MatrixXd stacked(const std::vector<Eigen::RowVectorXd>& rows, Eigen::Index columns) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t k = 0; k < rows.size(); ++k) out.row(static_cast<Eigen::Index>(k)) = rows[k];
  return out;
}

Eigen::VectorXd nearest(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs, double far) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(wanted.size());
  if (!(far > 0) || !std::isfinite(far)) return zero;
  std::vector<Eigen::RowVectorXd> rows;
  std::vector<double> bounds;
  for (const Slab& slab : slabs) {  // in units of the way there
    const double at = slab.row.dot(wanted) / far;
    if (slab.lower > -infinity) rows.push_back(slab.row), bounds.push_back(slab.lower / far - at);
    if (slab.upper < infinity) rows.push_back(-slab.row), bounds.push_back(at - slab.upper / far);
  }
  const Eigen::Map<const Eigen::VectorXd> h(bounds.data(), std::ssize(bounds));
  const Eigen::VectorXd found = wanted + far * least_point(stacked(rows, wanted.size()), h);
  const double allowed = decided * far;
  for (const Slab& slab : slabs) {
    const double at = slab.row.dot(found);
    if (!(at >= slab.lower - allowed && at <= slab.upper + allowed)) return zero;
  }
  return found;
}

Eigen::VectorXd within(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs) {
  return nearest(wanted, slabs, wanted.norm());
}

Eigen::VectorXd exactly_within(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs) {
  Eigen::VectorXd found = within(wanted, slabs);
  const double allowed = decided * wanted.norm();
  std::vector<Eigen::RowVectorXd> kept;
  for (const Slab& slab : slabs)
    if (std::min(-slab.lower, slab.upper) <= allowed && std::abs(slab.row.dot(found)) <= 2 * allowed)
      kept.push_back(slab.row);
  if (!kept.empty()) {
    const Eigen::MatrixXd along = null_space(stacked(kept, wanted.size()), decided);
    found = along * (along.transpose() * found);
  }
  double part = 1;
  for (const Slab& slab : slabs) {
    const double at = slab.row.dot(found), bound = at > 0 ? slab.upper : slab.lower;
    if (std::abs(bound) > allowed && std::abs(at) > std::abs(bound)) part = std::min(part, bound / at);
  }
  return part * found;
}

}  // namespace signorini
