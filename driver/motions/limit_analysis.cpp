#include "driver/motions/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/solver/functional.hpp"
#include "driver/motions/slabs.hpp"

namespace signorini {
namespace {

/// Where most of the loads press on bounds, the little that is left of them has few digits. Which bounds it does not
/// leave is seen all the same, and these leave the whole digits of the loads.
/// @param rows the bounded unknowns move by row . c
Eigen::VectorXd along_bounds(const Eigen::VectorXd& work, const Eigen::VectorXd& left,
                             const std::vector<Eigen::RowVectorXd>& rows) {
  constexpr double part = 1e-3, rounding_of_projections = 4e-12;
  const double small = part * left.norm() + rounding_of_projections * work.norm();
  std::vector<Eigen::RowVectorXd> kept;
  for (const Eigen::RowVectorXd& row : rows)
    if (std::abs(row.normalized().dot(left)) <= small) kept.push_back(row.normalized());
  const Eigen::MatrixXd along = null_space(stacked(kept, left.size()), FreeMotions<2, 2>::decided);
  return (along * (along.transpose() * work)).normalized();
}

}  // namespace

/// A motion has to leave, or to go along, what it is bounded by.
template <int D, int B>
void LimitAnalysis<D, B>::Ends::add(const Eigen::RowVectorXd& row) {
  allowed.bound(row, 0, infinity);
  rows.push_back(row);
}

/// By how much, of its length, a motion misses what the cone asks for that it misses most; infinite without cones.
template <int D, int B>
double LimitAnalysis<D, B>::Ends::worst(const Eigen::VectorXd& motion, std::size_t& cone) const {
  double out = infinity;
  for (std::size_t k = 0; k < cones.size(); ++k)
    if (const double excess = cones[k].excess(motion) / cones[k].size(); excess < out) out = excess, cone = k;
  return out / motion.norm();
}

/// The motion next to `work` of those that nothing ends, at least by what the conditions tell that are added for it:
/// cutting planes. Zero where it has no more than `enough` of it.
template <int D, int B>
Eigen::VectorXd LimitAnalysis<D, B>::Ends::nearest(const Eigen::VectorXd& work, double enough) {
  constexpr int most_cuts = 200;
  for (int cuts = 0; cuts < most_cuts; ++cuts) {
    Eigen::VectorXd found = allowed.nearest(work);
    if (!(found.norm() > enough)) break;
    std::size_t cone = 0;
    if (worst(found, cone) >= -0.1 * Free::negligible - Free::projected * work.norm() / found.norm()) return found;
    add(cones[cone].cut(found));
  }
  return Eigen::VectorXd::Zero(work.size());
}

/// What a motion is like where it leaves an obstacle only as far as friction asks for it: the way along that.
template <int D, int B>
Eigen::VectorXd LimitAnalysis<D, B>::Ends::slide(const Eigen::VectorXd& motion) const {
  std::vector<Eigen::RowVectorXd> touching;
  for (const Cone& cone : cones)
    if (cone.excess(motion) <= Free::decided * cone.size() * motion.norm()) touching.push_back(cone.away);
  const Eigen::MatrixXd basis = null_space(stacked(touching, motion.size()), Free::decided);
  return basis * (basis.transpose() * motion);
}

template <int D, int B>
void LimitAnalysis<D, B>::add_end(const Room& room, Ends& out) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  const Index slot = problem.constraints.slot[room.vertex];
  for (const double sign : {1.0, -1.0}) {
    if (std::abs(sign > 0 ? room.lower : room.upper) == infinity) continue;
    if (!(sign * room.normal > 0)) {
      out.add(sign * room.row);
      continue;
    }
    Cone cone{sign * room.row, Eigen::MatrixXd(B - 1, body_.free.cols()),
              sign * room.normal * body_.coefficient_of_friction(slot)};
    for (int k = 0, row = 0; k < B; ++k)
      if (problem.constraints.tangential[slot] >> k & 1u)
        cone.along.row(row++) = body_.motions.along(problem, room.vertex, k) * body_.free;
    if (cone.size() > Free::negligible) out.cones.push_back(std::move(cone));
  }
}

template <int D, int B>
auto LimitAnalysis<D, B>::ends() const -> Ends {
  Ends out{AllowedMotions(body_.free.cols()), {}, {}};
  for (const Room& room : body_.rooms(body_.discretization.problem.start)) add_end(room, out);
  return out;
}

template <int D, int B>
bool LimitAnalysis<D, B>::needs_friction() const {
  if (body_.free.cols() == 0) return false;
  AllowedMotions allowed(body_.free.cols());
  for (const Room& room : body_.rooms(body_.discretization.problem.start))
    if (room.row.norm() > Free::negligible) allowed.bound(room.row, room.lower, room.upper);
  return allowed.nearest(body_.work).norm() > Free::negligible * body_.most_work;
}

template <int D, int B>
void LimitAnalysis<D, B>::require_minimum() const {
  const double enough = Free::negligible * body_.most_work;
  if (body_.free.cols() == 0 || !(body_.work.norm() > enough)) return;
  Ends ends = this->ends();
  // What is left of the loads is a direction only if it is one by itself, too, and not rounding.
  const Eigen::VectorXd left = ends.nearest(body_.work, enough);
  if (!(left.norm() > enough)) return;
  const auto falls = [&](const Eigen::VectorXd& motion) {
    std::size_t cone = 0;
    return ends.allowed.least_rate(motion) >= -Free::negligible * motion.norm() &&
           ends.worst(motion, cone) >= -Free::negligible &&
           body_.work.dot(motion) - resistance(body_.free * motion) > enough * motion.norm();
  };
  Eigen::VectorXd motion = along_bounds(body_.work, left, ends.rows);
  if (!falls(motion)) motion = ends.nearest(left.normalized(), Free::negligible);
  if (falls(motion))
    throw Error(Exit::no_solution, fmt::format("{}: no solution: {} (contact is linearised about the undeformed body)",
                                               body_.model.origin, describe_fall(ends, motion)));
}

/// Friction takes what the motion along the obstacles gains over the one that leaves them.
template <int D, int B>
std::string LimitAnalysis<D, B>::describe_fall(const Ends& ends, const Eigen::VectorXd& motion) const {
  const Eigen::VectorXd slide = ends.slide(motion);
  const double taken = 1 - body_.work.dot(motion) / body_.work.dot(slide);
  if (!ends.cones.empty() && slide.norm() > Free::decided * motion.norm() && taken > Free::decided)
    return fmt::format(
        "friction does not hold the body against the loads: of their work along this motion friction takes at most "
        "{:.6g} %: {}",
        100 * taken, body_.motions.describe(body_.free * slide));
  const double part = body_.work.dot(motion) / (body_.most_work * motion.norm());
  return fmt::format(
      "the energy is unbounded below: nothing holds the body against the loads, which do work along this motion: {}{}",
      body_.motions.describe(body_.free * motion),
      part < std::sqrt(Free::decided)
          ? fmt::format(
                "; it is a part of {:.1g} of what they could do: if only the mesh's lack of symmetry makes them "
                "do any, expected loads that act about the axis itself, a fix, or some friction",
                part)
          : "");
}

// What functionals, such as friction, take of the work along a motion that goes on.
template <int D, int B>
double LimitAnalysis<D, B>::resistance(const Eigen::VectorXd& motion) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  if (body_.discretization.functional.empty()) return 0;
  std::vector<double> step(problem.b.size()), far;
  body_.add(motion, step);
  const double size = max_norm(step);
  if (slides_along(step, Free::negligible * size)) return infinity;
  double extent = max_norm(problem.constraints.last);
  for (const Point<D>& x : body_.nodes.mesh().points) extent = std::max(extent, max_norm(x));
  for (const double v : step) far.push_back(v / size * (extent / Free::negligible));
  return functional::slope(problem, far.data(), step.data());
}

// Whether a functional that follows the solution, by a law that is not known, may resist a motion as much as loads
// press: one that goes along its obstacle and does not leave it.
template <int D, int B>
bool LimitAnalysis<D, B>::slides_along(const std::vector<double>& step, double least) const {
  const Constraints<B>& c = body_.discretization.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    if (body_.discretization.functional[slot] < 0) continue;
    const Obstacle<B>& obstacle = *body_.model.obstacles[body_.discretization.functional[slot]].obstacle;
    if (!obstacle.renewal() || obstacle.friction()) continue;
    double away = 0, along = 0;
    for (int k = 0; k < B; ++k) {
      const double v = step[Offset{c.vector[slot]} * B + k];
      if (c.tangential[slot] >> k & 1u)
        along = std::max(along, std::abs(v));
      else
        away = std::max(away, v);
    }
    if (along > least && away <= least) return true;
  }
  return false;
}

template class LimitAnalysis<2, 1>;
template class LimitAnalysis<3, 1>;
template class LimitAnalysis<2, 2>;
template class LimitAnalysis<3, 3>;

}  // namespace signorini
