#include "driver/motions/loose_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/algebra/products.hpp"
#include "core/base/cone_projection.hpp"
#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/elements/select.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/force_split.hpp"
#include "driver/motions/limit_analysis.hpp"
#include "driver/motions/slabs.hpp"

namespace signorini {
namespace {

constexpr double weak = 1e-6;             // part of the largest force from which one surely is one
constexpr double force_rounding = 2e-14;  // part of the terms of a residual that is no force
constexpr double near = 0.1;              // of prescribed values: a motion that takes most of them away
constexpr double too_far = 100;           // ways over the size of the body, and turns: no place to be held at
constexpr double stays = 1e-6;            // of a motion: a bound that is left by less is not left

}  // namespace

template <int D, int B>
bool LooseBody<D, B>::needs_friction() const {
  return LimitAnalysis<D, B>(body_).needs_friction();
}

template <int D, int B>
void LooseBody<D, B>::require_minimum() const {
  LimitAnalysis<D, B>(body_).require_minimum();
}

/// The same of what presses on a vertex with faces, among which the force is divided.
template <int D, int B>
void LooseBody<D, B>::add_pressed(Index slot, const std::vector<double>& x, std::vector<double>& forces,
                                  std::vector<Eigen::RowVectorXd>& rows) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
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
    rows.push_back(body_.motions.along(problem, p, directions[k].data()) * body_.free);
  }
}

// Rows of what obstacles press on, which stays in contact, and with friction where it is.
template <int D, int B>
Eigen::MatrixXd LooseBody<D, B>::pressed(const std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  const Constraints<B>& c = problem.constraints;
  std::vector<double> forces;
  std::vector<Eigen::RowVectorXd> rows;
  double largest = 0, terms = 0;
  const double size = max_norm(x);
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
        rows.push_back(body_.motions.along(problem, p, k) * body_.free);
        for (int along = 0; along < B && body_.normal_component(slot) == k; ++along) {
          if (along == k) continue;
          forces.push_back(forces.back());
          rows.push_back(body_.motions.along(problem, p, along) * body_.free);
        }
      }
      terms = std::max(terms, std::abs(b) + problem.A.diagonal(p)[k * (B + 1)] * size);
    }
  }
  body_.each_polyhedron([&](Index slot) { add_pressed(slot, x, forces, rows); });
  for (const double force : forces) largest = std::max(largest, force);
  std::vector<Eigen::RowVectorXd> kept;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (forces[k] > std::max(weak * largest, force_rounding * terms) && rows[k].norm() > Free::negligible)
      kept.push_back(rows[k].normalized());
  if (body_.work.norm() > Free::negligible * body_.most_work) kept.push_back(body_.work.normalized().transpose());
  return stacked(kept, body_.free.cols());
}

// What a bound says of these motions, which are known to `decided`; zero where that hides it.
template <int D, int B>
Eigen::RowVectorXd LooseBody<D, B>::along(const Room& room, const Eigen::MatrixXd& costless) {
  const Eigen::RowVectorXd row = room.row * costless;
  if (row.norm() <= Free::decided * room.row.norm()) return Eigen::RowVectorXd::Zero(row.size());
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
    if (room.lower >= -Free::negligible * size) ends.push_back(row.normalized());
    if (room.upper <= Free::negligible * size) ends.push_back(-row.normalized());
  }
  const Eigen::MatrixXd G = stacked(ends, costless.cols());
  Eigen::MatrixXd found(costless.cols(), 2 * costless.cols());
  for (Eigen::Index k = 0; k < costless.cols(); ++k)
    for (const int sign : {0, 1})
      found.col(2 * k + sign) = project_onto_cone(G, (1 - 2 * sign) * Eigen::VectorXd::Unit(costless.cols(), k));
  if (!(found.norm() > Free::decided)) return Eigen::MatrixXd(body_.free.rows(), 0);
  const Eigen::MatrixXd orthogonal = null_space(found.transpose(), Free::decided);
  return body_.free * costless * null_space(orthogonal.transpose(), Free::decided);
}

// min (u + z(c), u + z(c)) over c, as the bounds allow, with the mean square over the body as the norm.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::least_motion(const std::vector<double>& x, const std::vector<Room>& rooms,
                                              const Eigen::MatrixXd& costless) const {
  const Eigen::MatrixXd basis = body_.free * costless;
  const std::vector<double> u = to_global(body_.discretization.problem, x),
                            mass = node_volumes(body_.nodes, body_.model.plane);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(body_.motions.count(), body_.motions.count());
  typename Motions::Motion h = Motions::Motion::Zero(body_.motions.count());
  for (Index p = 0; p < body_.nodes.size(); ++p)
    for (int i = 0; i < B; ++i) {
      double axis[B] = {};
      axis[i] = 1;
      const auto row = body_.motions.along(p, axis);
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
  const std::vector<double> u = to_global(body_.discretization.problem, x);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(body_.free.cols(), body_.free.cols());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(body_.free.cols());
  for (Index p = 0; p < body_.nodes.size(); ++p)
    for (int k = 0; k < B; ++k) {
      double d[B] = {};
      d[k] = 1;
      const Eigen::RowVectorXd row = body_.motions.along(p, d) * body_.free;
      normal += row.transpose() * row;
      right += row.transpose() * u[Offset{p} * B + k];
    }
  return body_.free * SymmetricFactors(normal).solve(right);
}

template <int D, int B>
double LooseBody<D, B>::turn(const Eigen::VectorXd& motion) const {
  if (B == 1) return 0;
  const Eigen::Index ways = motion.size() / Motions::modes * Motions::translations;
  return motion.tail(motion.size() - ways).cwiseAbs().maxCoeff() / body_.motions.size();
}

template <int D, int B>
bool LooseBody<D, B>::is_far_away(const std::vector<double>& x) const {
  if constexpr (B == 1) return false;
  const Eigen::VectorXd motion = nearest_motion(x);
  const Eigen::Index ways = motion.size() / Motions::modes * Motions::translations;
  return motion.head(ways).cwiseAbs().maxCoeff() > too_far * body_.motions.size() || turn(motion) > 1;
}

// A linear programme, by steps of growing length along the loads and back to what the bounds allow: their fixed points
// are its solutions, and a step that is long enough ends in one.
template <int D, int B>
std::vector<double> LooseBody<D, B>::fall(std::vector<double>& x) const {
  std::vector<double> way = as_prescribed();
  if (body_.none()) return way;
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  std::vector<double> rigid = way;
  Eigen::VectorXd motion = come_clear(rigid);
  make_admissible(problem, x);
  make_admissible(problem, rigid);
  if (body_.work.norm() > Free::negligible * body_.most_work) {
    let_fall(x);
    motion += let_fall(rigid);
    refuse_turned(motion);
  }
  body_.add(motion, way);
  if (lowers(problem, rigid, x)) x = std::move(rigid);
  return way;
}

// Bodies that fall straight land where they would. What ends a turn by more than that is no obstacle in its way, but
// one on the wrong side of its faces, or the tangent plane of one.
template <int D, int B>
void LooseBody<D, B>::refuse_turned(const Eigen::VectorXd& motion) const {
  if (!(turn(motion) > too_far)) return;
  input_error(body_.model.origin,
              fmt::format("obstacles would hold the body against the loads only where it has turned by {:.3g} degrees, "
                          "by {}: contact is linearised about the undeformed body, and says nothing of that; expected "
                          "obstacles in front of the faces on which they act, where the loads press these, or a fix",
                          turn(motion) * 180 / std::numbers::pi, body_.motions.describe(motion)));
}

// The rigid motion next to the prescribed values. None where these are far from it and nothing else moves the body
// rigidly: what is left of them would be as large as they are.
template <int D, int B>
std::vector<double> LooseBody<D, B>::as_prescribed() const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  const auto motion = body_.motions.nearest_to_prescribed(problem);
  if (body_.none() && (motion.isZero(0) || !is_near(motion))) return {};
  std::vector<double> out(problem.start.size());
  for (Index p = 0; p < body_.nodes.size(); ++p)
    for (int k = 0; k < B; ++k) out[Offset{p} * B + k] = body_.motions.along(problem, p, k) * motion;
  return out;
}

// Whether prescribed values are next to a motion.
template <int D, int B>
bool LooseBody<D, B>::is_near(const typename Motions::Motion& motion) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
  double largest = 0, rest = 0;
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B && problem.fixed[p] != 0; ++k) {
      if (!(problem.fixed[p] >> k & 1u)) continue;
      const double value = problem.start[p * B + static_cast<std::size_t>(k)];
      largest = std::max(largest, std::abs(value));
      rest = std::max(rest, std::abs(value - body_.motions.along(problem, static_cast<Index>(p), k) * motion));
    }
  return rest < near * largest;
}

// The least motion that takes x out of all obstacles, by which it moves x; zero where there is none.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::come_clear(std::vector<double>& x) const {
  double deepest = 0;
  std::vector<Slab> slabs;
  for (Room& room : body_.gaps(x)) {
    deepest = std::max({deepest, room.lower, -room.upper});
    slabs.push_back({std::move(room.row), room.lower, room.upper});
  }
  Eigen::VectorXd way = Eigen::VectorXd::Zero(body_.free.cols());
  if (deepest > 0) way = nearest(way, slabs, deepest);
  body_.add(body_.free * way, x);
  return body_.free * way;
}

// The motion by which it moves x.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::let_fall(std::vector<double>& x) const {
  constexpr int steps = 60;
  std::vector<Slab> slabs;
  for (Room& room : body_.rooms(x)) slabs.push_back({std::move(room.row), room.lower, room.upper});
  Eigen::VectorXd way = Eigen::VectorXd::Zero(body_.free.cols());
  double length = body_.motions.size();
  for (int k = 0; k < steps; ++k, length *= 2) {
    const Eigen::VectorXd next = within(way + length * body_.work.normalized(), slabs);
    const double progress = body_.work.dot(next - way) / body_.work.norm();
    if (!(progress > std::max(Free::negligible * next.norm(), Free::projected * length))) break;
    way = next;
  }
  move(body_.free * way, x);
  touch(Free::negligible * way.norm(), x);
  return body_.free * way;
}

// What rounding keeps off an obstacle that the body has come to.
template <int D, int B>
void LooseBody<D, B>::touch(double rounding, std::vector<double>& x) const {
  const Constraints<B>& c = body_.discretization.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      double& value = x[Offset{c.vector[slot]} * B + k];
      for (const double bound : {c.lower[Offset{slot} * B + k], c.upper[Offset{slot} * B + k]})
        if (std::abs(value - bound) <= rounding) value = bound;
    }
}

// As far as the bounds allow.
template <int D, int B>
void LooseBody<D, B>::move(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  body_.add(motion, x);
  const Constraints<B>& c = body_.discretization.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, x.data() + Offset{c.vector[slot]} * B);
}

// The same by a motion that is along the bounds as far as it is known: what is on a bound that the motion leaves by
// less than that stays there, for its force would be nobody's else.
template <int D, int B>
void LooseBody<D, B>::move_and_stay(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = body_.discretization.problem;
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

// Global coordinates.
template <int D, int B>
std::vector<double> LooseBody<D, B>::displacements(const Eigen::VectorXd& motion) const {
  std::vector<double> out;
  for (Index p = 0; p < body_.nodes.size(); ++p)
    for (int i = 0; i < B; ++i) {
      double axis[B] = {};
      axis[i] = 1;
      out.push_back(body_.motions.along(p, axis) * motion);
    }
  return out;
}

// Of forces at nodes, global coordinates, along each column.
template <int D, int B>
Eigen::VectorXd LooseBody<D, B>::work_along(const std::vector<double>& forces, const Eigen::MatrixXd& of) const {
  typename Motions::Row sum = Motions::Row::Zero(body_.motions.count());
  for (Index p = 0; p < body_.nodes.size(); ++p) sum += body_.motions.along(p, forces.data() + Offset{p} * B);
  return of.transpose() * sum.transpose();
}

// min 1/2 c'Hc - g'c as the bounds allow, in coordinates in which H is the identity.
template <int D, int B>
double LooseBody<D, B>::rest_on_springs(std::vector<double>& x) const {
  const Eigen::MatrixXd& basis = body_.sprung;
  if (basis.cols() == 0) return 0;
  Eigen::MatrixXd H(basis.cols(), basis.cols());
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    std::vector<double> forces(x.size());
    add_spring_forces(body_.nodes, body_.model, displacements(basis.col(k)), forces);
    H.col(k) = -work_along(forces, basis);
  }
  std::vector<double> forces = body_.discretization.load;
  add_spring_forces(body_.nodes, body_.model, to_global(body_.discretization.problem, x), forces);
  const Eigen::MatrixXd factor = cholesky((H + H.transpose()) / 2);
  const auto L = factor.triangularView<Eigen::Lower>();
  const Eigen::VectorXd best = L.solve(work_along(forces, basis));
  if (!best.allFinite()) return 0;  // stiffness of springs that is lost beside that of others
  std::vector<Slab> slabs;
  for (const Room& room : body_.rooms(x, basis))
    slabs.push_back({L.solve(room.row.transpose()).transpose(), room.lower, room.upper});
  const Eigen::VectorXd moved = exactly_within(best, slabs);
  move_and_stay(basis * L.transpose().solve(moved), x);
  return moved.norm();
}

template <int D, int B>
std::vector<std::string> LooseBody<D, B>::settle(std::vector<double>& x) const {
  if (body_.none() || !body_.only_pressed_friction()) return {};
  const Eigen::MatrixXd costless = null_space(pressed(x), Free::decided);
  if (costless.cols() == 0) return {};
  const std::vector<Room> room = body_.rooms(x);
  const double size = std::abs(*std::ranges::max_element(x, {}, [](double value) { return std::abs(value); }));
  const Eigen::MatrixXd open = undecided(room, costless, size);
  if (open.cols() == 0) return {};
  move_and_stay(body_.free * costless * least_motion(x, room, costless), x);
  std::vector<std::string> names;
  for (const auto& motion : body_.motions.simple_basis(open)) names.push_back(body_.motions.describe(motion));
  return names;
}

template class LooseBody<2, 1>;
template class LooseBody<3, 1>;
template class LooseBody<2, 2>;
template class LooseBody<3, 3>;

}  // namespace signorini
