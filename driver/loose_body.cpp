#include "driver/loose_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amg/coarse/cone_projection.hpp"
#include "core/algebra/products.hpp"
#include "core/base/dense.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/assemble.hpp"
#include "core/fem/force_split.hpp"
#include "core/fem/select.hpp"
#include "core/mesh/connected.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/functional.hpp"

namespace signorini {
namespace {

constexpr double negligible = 1e-10;      // part of the most that is possible: work of loads, components of motions
constexpr double projected = 1e-13;       // of what is projected: rounding
constexpr double weak = 1e-6;             // part of the largest force from which one surely is one
constexpr double force_rounding = 2e-14;  // part of the terms of a residual that is no force
constexpr double near = 0.1;              // of prescribed values: a motion that takes most of them away
constexpr double decided = 1e-8;          // singular values of what forces forbid, relative to the largest
constexpr double stays = 1e-6;            // of a motion: a bound that is left by less is not left

Eigen::MatrixXd stacked(const std::vector<Eigen::RowVectorXd>& rows, Eigen::Index columns) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t k = 0; k < rows.size(); ++k) out.row(static_cast<Eigen::Index>(k)) = rows[k];
  return out;
}

/// lower <= row . c <= upper
struct Slab {
  Eigen::RowVectorXd row;
  double lower, upper;
};

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

/// The point within all slabs that is next to `wanted`, at about the distance `far`; zero where there is none, or
/// rounding does not let it be found.
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

/// The same where zero is within all slabs.
Eigen::VectorXd within(const Eigen::VectorXd& wanted, const std::vector<Slab>& slabs) {
  return nearest(wanted, slabs, wanted.norm());
}

/// The same without what the search loses of digits that the rows have, for a stiff body would have large forces from
/// that: along sides that zero is next to, the point stays as far off them as zero is, and it is taken back towards
/// zero where it violates others.
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
  const Eigen::MatrixXd along = null_space(stacked(kept, left.size()), decided);
  return (along * (along.transpose() * work)).normalized();
}

/// Per node the body it belongs to; empty where there is one.
template <int D, int B>
std::vector<Index> bodies_of(const Nodes<D>& nodes, const Model<B>& model) {
  return is_paired(model) ? connected_parts(nodes.mesh()) : std::vector<Index>();
}

}  // namespace

template <int D, int B>
LooseBody<D, B>::LooseBody(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization)
    : nodes_(nodes),
      model_(model),
      discretization_(discretization),
      motions_(nodes, model.plane, bodies_of(nodes, model)),
      free_(motions_.free(discretization.problem)) {
  if (free_.cols() > 0) add_work();
}

// Of the loads themselves: what prescribed values add to the right-hand side does none.
template <int D, int B>
void LooseBody<D, B>::add_work() {
  const std::vector<double>& loads = discretization_.load;
  typename Motions::Row work = Motions::Row::Zero(motions_.count());
  for (Index p = 0; p < nodes_.size(); ++p) {
    const double* b = loads.data() + Offset{p} * B;
    const auto here = motions_.along(p, b);
    work += here;
    most_work_ += here.norm();
  }
  work_ = free_.transpose() * work.transpose();
}

/// What the bounds leave to an admissible iterate.
template <int D, int B>
auto LooseBody<D, B>::rooms(const std::vector<double>& x) const -> std::vector<Room> {
  std::vector<Room> out = gaps(x);
  for (Room& room : out) {
    room.lower = std::min(room.lower, 0.0);
    room.upper = std::max(room.upper, 0.0);
  }
  return out;
}

/// What the bounds leave to an iterate; those that are not part of the problem, too.
template <int D, int B>
auto LooseBody<D, B>::gaps(const std::vector<double>& x) const -> std::vector<Room> {
  std::vector<Room> out;
  const DiscreteProblem<B>& problem = discretization_.problem;
  const auto add = [&](Index p, const Eigen::RowVectorXd& row, double lower, double upper, double normal) {
    if (row.norm() > negligible || normal != 0) out.push_back({p, row, lower, upper, normal});
  };
  for (Index slot = 0; slot < problem.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k;
      const double lower = problem.constraints.lower[at], upper = problem.constraints.upper[at];
      if (lower == -infinity && upper == infinity) continue;
      const Index p = problem.constraints.vector[slot];
      const double value = x[Offset{p} * B + k];
      add(p, motions_.along(problem, p, k) * free_, lower - value, upper - value, k == normal_component(slot) ? 1 : 0);
    }
  each_polyhedron([&](Index slot) {
    const Constraints<B>& c = problem.constraints;
    const Index p = c.vector[slot];
    for (Offset f = c.facet_row[slot]; f < c.facet_row[slot + 1]; ++f) {
      const Facet<B>& face = c.facet[f];
      double direction[B], value = 0;
      block::product<B>(problem.frames.dual_at(p), face.normal, direction);
      for (int k = 0; k < B; ++k) value += face.normal[k] * x[Offset{p} * B + k];
      const int k = normal_component(slot);
      add(p, motions_.along(problem, p, direction) * free_, face.lower - value, face.upper - value,
          k < 0 ? 0 : face.normal[k]);
    }
  });
  return out;
}

/// Calls visit(slot) for those with faces.
template <int D, int B>
template <class Visit>
void LooseBody<D, B>::each_polyhedron(const Visit& visit) const {
  const Constraints<B>& c = discretization_.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    if (c.has_facets(slot)) visit(slot);
}

/// A motion has to leave, or to go along, what it is bounded by.
template <int D, int B>
void LooseBody<D, B>::Ends::add(const Eigen::RowVectorXd& row) {
  allowed.bound(row, 0, infinity);
  rows.push_back(row);
}

/// By how much, of its length, a motion misses what the cone asks for that it misses most; infinite without cones.
template <int D, int B>
double LooseBody<D, B>::Ends::worst(const Eigen::VectorXd& motion, std::size_t& cone) const {
  double out = infinity;
  for (std::size_t k = 0; k < cones.size(); ++k)
    if (const double excess = cones[k].excess(motion) / cones[k].size(); excess < out) out = excess, cone = k;
  return out / motion.norm();
}

/// The motion next to `work` of those that nothing ends, at least by what the conditions tell that are added for it:
/// cutting planes. Zero where it has no more than `enough` of it.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::Ends::nearest(const Eigen::VectorXd& work, double enough) {
  constexpr int most_cuts = 200;
  for (int cuts = 0; cuts < most_cuts; ++cuts) {
    Eigen::VectorXd found = allowed.nearest(work);
    if (!(found.norm() > enough)) break;
    std::size_t cone = 0;
    if (worst(found, cone) >= -0.1 * negligible - projected * work.norm() / found.norm()) return found;
    add(cones[cone].cut(found));
  }
  return Eigen::VectorXd::Zero(work.size());
}

/// What a motion is like where it leaves an obstacle only as far as friction asks for it: the way along that.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::Ends::slide(const Eigen::VectorXd& motion) const {
  std::vector<Eigen::RowVectorXd> touching;
  for (const Cone& cone : cones)
    if (cone.excess(motion) <= decided * cone.size() * motion.norm()) touching.push_back(cone.away);
  const Eigen::MatrixXd basis = null_space(stacked(touching, motion.size()), decided);
  return basis * (basis.transpose() * motion);
}

/// The component across the obstacle at a slot with friction, -1 elsewhere.
template <int D, int B>
int LooseBody<D, B>::normal_component(Index slot) const {
  if (!(coefficient_of_friction(slot) > 0)) return -1;
  const Flags tangential = discretization_.problem.constraints.tangential[slot];
  for (int k = 0; k < B; ++k)
    if (!(tangential >> k & 1u)) return k;
  return -1;
}

template <int D, int B>
void LooseBody<D, B>::add_end(const Room& room, Ends& out) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const Index slot = problem.constraints.slot[room.vertex];
  for (const double sign : {1.0, -1.0}) {
    if (std::abs(sign > 0 ? room.lower : room.upper) == infinity) continue;
    if (!(sign * room.normal > 0)) {
      out.add(sign * room.row);
      continue;
    }
    Cone cone{sign * room.row, Eigen::MatrixXd(B - 1, free_.cols()),
              sign * room.normal * coefficient_of_friction(slot)};
    for (int k = 0, row = 0; k < B; ++k)
      if (problem.constraints.tangential[slot] >> k & 1u)
        cone.along.row(row++) = motions_.along(problem, room.vertex, k) * free_;
    if (cone.size() > negligible) out.cones.push_back(std::move(cone));
  }
}

template <int D, int B>
auto LooseBody<D, B>::ends() const -> Ends {
  Ends out{AllowedMotions(free_.cols()), {}, {}};
  for (const Room& room : rooms(discretization_.problem.start)) add_end(room, out);
  return out;
}

template <int D, int B>
bool LooseBody<D, B>::needs_friction() const {
  if (free_.cols() == 0) return false;
  AllowedMotions allowed(free_.cols());
  for (const Room& room : rooms(discretization_.problem.start))
    if (room.row.norm() > negligible) allowed.bound(room.row, room.lower, room.upper);
  return allowed.nearest(work_).norm() > negligible * most_work_;
}

template <int D, int B>
void LooseBody<D, B>::require_minimum() const {
  const double enough = negligible * most_work_;
  if (free_.cols() == 0 || !(work_.norm() > enough)) return;
  Ends ends = this->ends();
  // What is left of the loads is a direction only if it is one by itself, too, and not rounding.
  const Eigen::VectorXd left = ends.nearest(work_, enough);
  if (!(left.norm() > enough)) return;
  const auto falls = [&](const Eigen::VectorXd& motion) {
    std::size_t cone = 0;
    return ends.allowed.least_rate(motion) >= -negligible * motion.norm() && ends.worst(motion, cone) >= -negligible &&
           work_.dot(motion) - resistance(free_ * motion) > enough * motion.norm();
  };
  Eigen::VectorXd motion = along_bounds(work_, left, ends.rows);
  if (!falls(motion)) motion = ends.nearest(left.normalized(), negligible);
  if (falls(motion))
    throw Error(Exit::no_solution, fmt::format("{}: no solution: {} (contact is linearised about the undeformed body)",
                                               model_.origin, describe_fall(ends, motion)));
}

/// Friction takes what the motion along the obstacles gains over the one that leaves them.
template <int D, int B>
std::string LooseBody<D, B>::describe_fall(const Ends& ends, const Eigen::VectorXd& motion) const {
  const Eigen::VectorXd slide = ends.slide(motion);
  const double taken = 1 - work_.dot(motion) / work_.dot(slide);
  if (!ends.cones.empty() && slide.norm() > decided * motion.norm() && taken > decided)
    return fmt::format(
        "friction does not hold the body against the loads: of the work that these do along this motion it takes "
        "{:.6g} % at most: {}",
        100 * taken, motions_.describe(free_ * slide));
  return fmt::format(
      "the energy is unbounded below: nothing holds the body against the loads, which do work along this motion: {}",
      motions_.describe(free_ * motion));
}

// What functionals, such as friction, take of the work along a motion that goes on.
template <int D, int B>
double LooseBody<D, B>::resistance(const Eigen::VectorXd& motion) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  if (discretization_.functional.empty()) return 0;
  std::vector<double> step(problem.b.size()), far;
  add(motion, step);
  double size = 0, extent = 0;
  for (const double v : step) size = std::max(size, std::abs(v));
  if (slides_along(step, negligible * size)) return infinity;
  for (const double v : problem.constraints.last) extent = std::max(extent, std::abs(v));
  for (const Point<D>& x : nodes_.mesh().points)
    for (const double v : x) extent = std::max(extent, std::abs(v));
  for (const double v : step) far.push_back(v / size * (extent / negligible));
  return functional::slope(problem, far.data(), step.data());
}

// Whether a functional that follows the solution, by a law that is not known, may resist a motion as much as loads
// press: one that goes along its obstacle and does not leave it.
template <int D, int B>
bool LooseBody<D, B>::slides_along(const std::vector<double>& step, double least) const {
  const Constraints<B>& c = discretization_.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    if (discretization_.functional[slot] < 0) continue;
    const Obstacle<B>& obstacle = *model_.obstacles[discretization_.functional[slot]].obstacle;
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

template <int D, int B>
double LooseBody<D, B>::coefficient_of_friction(Index slot) const {
  if (discretization_.functional.empty() || discretization_.functional[slot] < 0) return 0;
  const Constraints<B>& c = discretization_.problem.constraints;
  const Friction* friction = model_.obstacles[discretization_.functional[slot]].obstacle->friction();
  return friction ? friction->law(c.data.data() + Offset{slot} * c.width).coefficient : 0;
}

/// The same of what presses on a vertex with faces, among which the force is divided.
template <int D, int B>
void LooseBody<D, B>::add_pressed(Index slot, const std::vector<double>& x, std::vector<double>& forces,
                                  std::vector<Eigen::RowVectorXd>& rows) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const Constraints<B>& c = problem.constraints;
  const Index p = c.vector[slot];
  const double *N = problem.frames.dual_at(p), *v = x.data() + Offset{p} * B;
  std::vector<std::array<double, B>> directions;
  const auto add = [&](const double* local, double sign) {
    double direction[B];
    block::product<B>(N, local, direction);
    std::array<double, B>& last = directions.emplace_back();
    for (int i = 0; i < B; ++i) last[i] = sign * direction[i];
  };
  for (int k = 0; k < B; ++k) {
    double axis[B] = {};
    axis[k] = 1;
    if (v[k] <= c.lower[Offset{slot} * B + k]) add(axis, 1);
    if (v[k] >= c.upper[Offset{slot} * B + k]) add(axis, -1);
  }
  const Polyhedron<B> polyhedron = c.polyhedron(slot);
  for (int k = 0; k < polyhedron.facets(); ++k) {
    const auto [below, above] = polyhedron.room(k, v);
    if (below == 0) add(polyhedron.facet(k).normal, 1);
    if (above == 0) add(polyhedron.facet(k).normal, -1);
  }
  double r[B];
  std::array<double, B> force;
  row_product(problem.A, p, x.data(), r);
  for (int k = 0; k < B; ++k) r[k] = problem.fixed[p] >> k & 1u ? 0 : r[k] - problem.b[Offset{p} * B + k];
  block::product<B>(N, r, force.data());
  const ForceSplit split = split_force<B>(directions, force);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    forces.push_back(split.part[k]);
    rows.push_back(motions_.along(problem, p, directions[k].data()) * free_);
  }
}

// Rows of what obstacles press on, which stays in contact.
template <int D, int B>
Eigen::MatrixXd LooseBody<D, B>::pressed(const std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const Constraints<B>& c = problem.constraints;
  std::vector<double> forces;
  std::vector<Eigen::RowVectorXd> rows;
  double largest = 0, terms = 0, size = 0;
  for (const double value : x) size = std::max(size, std::abs(value));
  for (Index slot = 0; slot < c.size(); ++slot) {
    const Index p = c.vector[slot];
    double Ax[B];
    row_product(problem.A, p, x.data(), Ax);
    for (int k = 0; k < B; ++k) {
      const double value = x[Offset{p} * B + k], b = problem.b[Offset{p} * B + k];
      const bool below = value <= c.lower[Offset{slot} * B + k], above = value >= c.upper[Offset{slot} * B + k];
      if (!below && !above) continue;
      const double force = Ax[k] - b;
      if (!c.has_facets(slot)) {
        forces.push_back(below && above ? std::abs(force) : below ? force : -force);
        rows.push_back(motions_.along(problem, p, k) * free_);
      }
      terms = std::max(terms, std::abs(b) + problem.A.diagonal(p)[k * (B + 1)] * size);
    }
  }
  each_polyhedron([&](Index slot) { add_pressed(slot, x, forces, rows); });
  for (const double force : forces) largest = std::max(largest, force);
  std::vector<Eigen::RowVectorXd> kept;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (forces[k] > std::max(weak * largest, force_rounding * terms) && rows[k].norm() > negligible)
      kept.push_back(rows[k].normalized());
  if (work_.norm() > negligible * most_work_) kept.push_back(work_.normalized().transpose());
  return stacked(kept, free_.cols());
}

// What a bound says of these motions, which are known to `decided`; zero where that hides it.
template <int D, int B>
Eigen::RowVectorXd LooseBody<D, B>::along(const Room& room, const Eigen::MatrixXd& costless) {
  const Eigen::RowVectorXd row = room.row * costless;
  if (row.norm() <= decided * room.row.norm()) return Eigen::RowVectorXd::Zero(row.size());
  return row;
}

// Motions that bounds end at once in every direction are decided: what is left of the others spans them.
template <int D, int B>
Eigen::MatrixXd LooseBody<D, B>::undecided(const std::vector<Room>& rooms, const Eigen::MatrixXd& costless,
                                           double size) const {
  std::vector<Eigen::RowVectorXd> ends;
  for (const Room& room : rooms) {
    const Eigen::RowVectorXd row = along(room, costless);
    if (row.norm() == 0) continue;
    if (room.lower >= -negligible * size) ends.push_back(row.normalized());
    if (room.upper <= negligible * size) ends.push_back(-row.normalized());
  }
  const Eigen::MatrixXd G = stacked(ends, costless.cols());
  Eigen::MatrixXd found(costless.cols(), 2 * costless.cols());
  for (Eigen::Index k = 0; k < costless.cols(); ++k)
    for (const int sign : {0, 1})
      found.col(2 * k + sign) = project_onto_cone(G, (1 - 2 * sign) * Eigen::VectorXd::Unit(costless.cols(), k));
  if (!(found.norm() > decided)) return Eigen::MatrixXd(free_.rows(), 0);
  const Eigen::MatrixXd orthogonal = null_space(found.transpose(), decided);
  return free_ * costless * null_space(orthogonal.transpose(), decided);
}

// min (u + z(c), u + z(c)) over c, as the bounds allow, with the mean square over the body as the norm.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::least_motion(const std::vector<double>& x, const std::vector<Room>& rooms,
                                              const Eigen::MatrixXd& costless) const {
  const Eigen::MatrixXd basis = free_ * costless;
  const std::vector<double> u = to_global(discretization_.problem, x), mass = node_volumes(nodes_, model_.plane);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(motions_.count(), motions_.count());
  typename Motions::Motion h = Motions::Motion::Zero(motions_.count());
  for (Index p = 0; p < nodes_.size(); ++p)
    for (int i = 0; i < B; ++i) {
      double axis[B] = {};
      axis[i] = 1;
      const auto row = motions_.along(p, axis);
      H += mass[p] * row.transpose() * row;
      h += mass[p] * u[Offset{p} * B + i] * row.transpose();
    }
  const Eigen::MatrixXd factor = cholesky(basis.transpose() * H * basis);
  const auto L = factor.triangularView<Eigen::Lower>();
  const Eigen::VectorXd best =
      -L.solve(basis.transpose() * h);  // in coordinates in which the norm is the Euclidean one
  std::vector<Slab> slabs;              // in the same coordinates
  for (const Room& room : rooms) {
    const Eigen::VectorXd row = along(room, costless).transpose();
    if (row.norm() > 0) slabs.push_back({L.solve(row).transpose(), room.lower, room.upper});
  }
  const Eigen::VectorXd moved = exactly_within(best, slabs);
  return L.transpose().solve(moved);
}

// By least squares over the nodes.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::nearest_motion(const std::vector<double>& x) const {
  const std::vector<double> u = to_global(discretization_.problem, x);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(free_.cols(), free_.cols());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(free_.cols());
  for (Index p = 0; p < nodes_.size(); ++p)
    for (int k = 0; k < B; ++k) {
      double d[B] = {};
      d[k] = 1;
      const Eigen::RowVectorXd row = motions_.along(p, d) * free_;
      normal += row.transpose() * row;
      right += row.transpose() * u[Offset{p} * B + k];
    }
  return free_ * SymmetricFactors(normal).solve(right);
}

template <int D, int B>
bool LooseBody<D, B>::is_far_away(const std::vector<double>& x) const {
  constexpr double far = 100;  // times the size
  if constexpr (B == 1) return false;
  const Eigen::VectorXd motion = nearest_motion(x);
  const Eigen::Index ways = motion.size() / Motions::modes * Motions::translations;
  const Eigen::VectorXd way = motion.head(ways), turn = motion.tail(motion.size() - ways);
  return way.cwiseAbs().maxCoeff() > far * motions_.size() || turn.cwiseAbs().maxCoeff() > motions_.size();
}

// A linear programme, by steps of growing length along the loads and back to what the bounds allow: their fixed points
// are its solutions, and a step that is long enough ends in one.
template <int D, int B>
std::vector<double> LooseBody<D, B>::fall(std::vector<double>& x) const {
  std::vector<double> way = as_prescribed();
  if (free_.cols() == 0) return way;
  const DiscreteProblem<B>& problem = discretization_.problem;
  std::vector<double> rigid = way;
  add(come_clear(rigid), way);
  make_admissible(problem, x);
  make_admissible(problem, rigid);
  if (work_.norm() > negligible * most_work_) {
    let_fall(x);
    add(let_fall(rigid), way);
  }
  if (lowers(problem, rigid, x)) x = std::move(rigid);
  return way;
}

// The rigid motion next to the prescribed values. None where these are far from it and nothing else moves the body
// rigidly: what is left of them would be as large as they are.
template <int D, int B>
std::vector<double> LooseBody<D, B>::as_prescribed() const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const auto motion = motions_.nearest_to_prescribed(problem);
  if (free_.cols() == 0 && (motion.isZero(0) || !is_near(motion))) return {};
  std::vector<double> out(problem.start.size());
  for (Index p = 0; p < nodes_.size(); ++p)
    for (int k = 0; k < B; ++k) out[Offset{p} * B + k] = motions_.along(problem, p, k) * motion;
  return out;
}

// Whether prescribed values are next to a motion.
template <int D, int B>
bool LooseBody<D, B>::is_near(const typename Motions::Motion& motion) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  double largest = 0, rest = 0;
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B && problem.fixed[p] != 0; ++k) {
      if (!(problem.fixed[p] >> k & 1u)) continue;
      const double value = problem.start[p * B + static_cast<std::size_t>(k)];
      largest = std::max(largest, std::abs(value));
      rest = std::max(rest, std::abs(value - motions_.along(problem, static_cast<Index>(p), k) * motion));
    }
  return rest < near * largest;
}

// The least motion that takes x out of all obstacles, by which it moves x; zero where there is none.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::come_clear(std::vector<double>& x) const {
  double deepest = 0;
  std::vector<Slab> slabs;
  for (Room& room : gaps(x)) {
    deepest = std::max({deepest, room.lower, -room.upper});
    slabs.push_back({std::move(room.row), room.lower, room.upper});
  }
  Eigen::VectorXd way = Eigen::VectorXd::Zero(free_.cols());
  if (deepest > 0) way = nearest(way, slabs, deepest);
  add(free_ * way, x);
  return free_ * way;
}

// The motion by which it moves x.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::let_fall(std::vector<double>& x) const {
  constexpr int steps = 60;
  std::vector<Slab> slabs;
  for (Room& room : rooms(x)) slabs.push_back({std::move(room.row), room.lower, room.upper});
  Eigen::VectorXd way = Eigen::VectorXd::Zero(free_.cols());
  double length = motions_.size();
  for (int k = 0; k < steps; ++k, length *= 2) {
    const Eigen::VectorXd next = within(way + length * work_.normalized(), slabs);
    const double progress = work_.dot(next - way) / work_.norm();
    if (!(progress > std::max(negligible * next.norm(), projected * length))) break;
    way = next;
  }
  move(free_ * way, x);
  touch(negligible * way.norm(), x);
  return free_ * way;
}

// What rounding keeps off an obstacle that the body has come to.
template <int D, int B>
void LooseBody<D, B>::touch(double rounding, std::vector<double>& x) const {
  const Constraints<B>& c = discretization_.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      double& value = x[Offset{c.vector[slot]} * B + k];
      for (const double bound : {c.lower[Offset{slot} * B + k], c.upper[Offset{slot} * B + k]})
        if (std::abs(value - bound) <= rounding) value = bound;
    }
}

template <int D, int B>
void LooseBody<D, B>::add(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const double size = motion.norm();
  for (Index p = 0; p < nodes_.size(); ++p)
    for (int k = 0; k < B; ++k) {
      if (problem.fixed[p] >> k & 1u) continue;
      const double by = motions_.along(problem, p, k) * motion;
      if (std::abs(by) > rounding_of_sums * size) x[Offset{p} * B + k] += by;
    }
}

// As far as the bounds allow.
template <int D, int B>
void LooseBody<D, B>::move(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  add(motion, x);
  const Constraints<B>& c = discretization_.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, x.data() + Offset{c.vector[slot]} * B);
}

// The same by a motion that is along the bounds as far as it is known: what is on a bound that the motion leaves by
// less than that stays there, for its force would be nobody's else.
template <int D, int B>
void LooseBody<D, B>::move_and_stay(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = discretization_.problem;
  const Constraints<B>& c = problem.constraints;
  const std::vector<double> before = x;
  move(motion, x);
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{c.vector[slot]} * B + k;
      const bool touches = before[at] <= c.lower[Offset{slot} * B + k] || before[at] >= c.upper[Offset{slot} * B + k];
      if (touches && std::abs(x[at] - before[at]) <= stays * motion.norm()) x[at] = before[at];
    }
}

template <int D, int B>
std::vector<std::string> LooseBody<D, B>::settle(std::vector<double>& x) const {
  if (free_.cols() == 0) return {};
  const Eigen::MatrixXd costless = null_space(pressed(x), decided);
  if (costless.cols() == 0) return {};
  const std::vector<Room> room = rooms(x);
  const double size = std::abs(*std::ranges::max_element(x, {}, [](double value) { return std::abs(value); }));
  const Eigen::MatrixXd open = undecided(room, costless, size);
  if (open.cols() == 0) return {};
  move_and_stay(free_ * costless * least_motion(x, room, costless), x);
  std::vector<std::string> names;
  for (const auto& motion : motions_.simple_basis(open)) names.push_back(motions_.describe(motion));
  return names;
}

template class LooseBody<2, 1>;
template class LooseBody<3, 1>;
template class LooseBody<2, 2>;
template class LooseBody<3, 3>;

}  // namespace signorini
