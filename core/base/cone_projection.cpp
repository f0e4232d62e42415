#include "core/base/cone_projection.hpp"

#include <algorithm>
#include <vector>

#include "core/base/dense.hpp"
#include "core/base/rounding.hpp"

namespace signorini {

namespace {

constexpr double tolerance = rounding_of_differences;  // part of |c| by which a condition may be missed
constexpr double nothing = 1e-15;                      // part of |g| that is rounding

/// Columns G_j' of the conditions that hold as equalities.
Eigen::MatrixXd columns(const Eigen::MatrixXd& G, const std::vector<Eigen::Index>& active) {
  Eigen::MatrixXd out(G.cols(), static_cast<Eigen::Index>(active.size()));
  for (std::size_t k = 0; k < active.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = G.row(active[k]).transpose();
  return out;
}

/// Goes from the multipliers towards the best ones as far as none turns negative; conditions with a zero one leave.
/// Returns whether the best ones were reached.
bool advance(std::vector<Eigen::Index>& active, std::vector<double>& multiplier, const Eigen::VectorXd& best) {
  double step = 1;
  for (std::size_t k = 0; k < active.size(); ++k)
    if (const double to = best[static_cast<Eigen::Index>(k)]; to <= 0)
      step = std::min(step, multiplier[k] / (multiplier[k] - to));
  std::size_t kept = 0;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const double value = multiplier[k] + step * (best[static_cast<Eigen::Index>(k)] - multiplier[k]);
    if (step < 1 && value <= 1e-15 * std::abs(multiplier[k])) continue;
    active[kept] = active[k];
    multiplier[kept++] = value;
  }
  const bool all = step == 1;
  active.resize(kept);
  multiplier.resize(kept);
  return all;
}

/// Takes off c what is along some orthonormal columns, to rounding of what is left: twice is enough, however little
/// that is.
void orthogonalise(const Eigen::MatrixXd& Q, Eigen::VectorXd& c) {
  for (int pass = 0; pass < 2; ++pass) c -= Q * (Q.transpose() * c);
}

}  // namespace

Eigen::VectorXd project_onto_cone(const Eigen::MatrixXd& G, const Eigen::VectorXd& g) {
  std::vector<Eigen::Index> active;
  std::vector<double> multiplier;
  Eigen::VectorXd c = g;
  for (Eigen::Index round = 0; round < 3 * G.rows(); ++round) {
    Eigen::Index worst = 0;
    const bool missed = (G * c).minCoeff(&worst) < -tolerance * c.norm();
    if (!missed || !(c.norm() > nothing * g.norm()) || std::ranges::count(active, worst)) break;
    active.push_back(worst);
    multiplier.push_back(0);
    LeastSquares nearest;
    do {
      if (active.empty()) return g;
      nearest = least_squares(columns(G, active), -g);
    } while (!advance(active, multiplier, nearest.x));
    c = g;
    orthogonalise(nearest.range, c);
  }
  return c;
}

}  // namespace signorini
