#include "core/fem/motions/rigid_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/motions/deciding_rows.hpp"
#include "core/mesh/join.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {
namespace {

/// Gauss-Jordan elimination of the columns such that each has one of the rows first <= row < last to itself; in the
/// order of these.
void reduce_columns(Eigen::MatrixXd& columns, Eigen::Index first, Eigen::Index last) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> order;  // row of each column
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::Index row = 0, column = 0;
    columns.middleRows(first, last - first).rightCols(columns.cols() - k).cwiseAbs().maxCoeff(&row, &column);
    row += first;
    columns.col(k).swap(columns.col(k + column));
    columns.col(k) /= double{columns(row, k)};
    for (Eigen::Index j = 0; j < columns.cols(); ++j)
      if (j != k) columns.col(j) -= (double{columns(row, j)} * columns.col(k)).eval();
    order.emplace_back(row, k);
  }
  std::ranges::sort(order);
  const Eigen::MatrixXd reduced = columns;
  for (std::size_t k = 0; k < order.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = reduced.col(order[k].second);
}

template <int D>
Point<D> filled(double value) {
  Point<D> out;
  out.fill(value);
  return out;
}

template <class Vector>
std::string text(const Vector& values) {
  const double largest = max_norm({values.data(), static_cast<std::size_t>(values.size())});
  std::string out;
  for (const double v : values)
    out += fmt::format("{}{:.6g}", out.empty() ? "" : ", ", std::abs(v) <= 1e-9 * largest ? 0.0 : v);
  return "(" + out + ")";
}

}  // namespace

template <int D, int B>
RigidMotions<D, B>::RigidMotions(const Nodes<D>& nodes, Plane plane, std::vector<Index> of_node)
    : nodes_(nodes), axial_(B > 1 && plane == Plane::axisymmetric), of_node_(std::move(of_node)) {
  const auto body_at = [this](Index v) {
    return of_node_.empty() ? std::size_t{0} : static_cast<std::size_t>(of_node_[nodes_.of_vertex(v)]);
  };
  const std::vector<Point<D>>& points = nodes.mesh().points;
  for (Index v = 0; v < nodes.mesh().vertices(); ++v) {
    if (bodies_.size() <= body_at(v)) bodies_.resize(body_at(v) + 1, {filled<D>(infinity), filled<D>(-infinity)});
    Body& body = bodies_[body_at(v)];
    for (int i = 0; i < D; ++i) {
      body.low[i] = std::min(body.low[i], points[v][i]);
      body.high[i] = std::max(body.high[i], points[v][i]);
    }
  }
  for (Body& body : bodies_) {
    for (int i = 0; i < D; ++i) {
      body.middle[i] = 0.5 * (body.low[i] + body.high[i]);
      body.size = std::max(body.size, 0.5 * (body.high[i] - body.low[i]));
    }
    size_ = std::max(size_, body.size);
  }
}

/// Adds how much each mode moves p along d.
template <int D, int B>
void RigidMotions<D, B>::add(Index p, const double* d, Row& row) const {
  const auto number = of_node_.empty() ? 0 : of_node_[p];
  double* shift = row.data() + number * translations;
  if (axial_) {
    if constexpr (B > 1) shift[1] += d[1];
    return;
  }
  for (int i = 0; i < translations; ++i) shift[i] += d[i];
  if constexpr (B > 1) {
    double* turn = row.data() + static_cast<int>(bodies_.size()) * translations + number * (modes - translations);
    const Body& body = bodies_[number];
    const Point<D> x = nodes_.control_point(p);
    Point<D> y;
    for (int i = 0; i < D; ++i) y[i] = (x[i] - body.middle[i]) / body.size;
    if constexpr (D == 2) turn[0] += (y[0] * d[1] - y[1] * d[0]);
    if constexpr (D == 3)
      for (int i = 0; i < 3; ++i) turn[i] += (y[(i + 1) % 3] * d[(i + 2) % 3] - y[(i + 2) % 3] * d[(i + 1) % 3]);
  }
}

template <int D, int B>
auto RigidMotions<D, B>::along(Index p, const double* d) const -> Row {
  Row row = Row::Zero(count());
  add(p, d, row);
  return row;
}

template <int D, int B>
auto RigidMotions<D, B>::along(const DiscreteProblem<B>& problem, Index p, const double* d) const -> Row {
  if (!problem.jumps) return along(p, d);
  const Jumps<B>& jumps = *problem.jumps;
  const auto found = std::ranges::lower_bound(jumps.vector, p);
  if (found == jumps.vector.end() || *found != p) return along(p, d);
  const Offset s = found - jumps.vector.begin();
  Row row = Row::Zero(count());
  for (Offset k = jumps.inverse.row[s]; k < jumps.inverse.row[s + 1]; ++k) {
    double through[B];
    block::transposed_product<B>(jumps.inverse.at(k), d, through);
    add(jumps.inverse.column[k], through, row);
  }
  return row;
}

template <int D, int B>
auto RigidMotions<D, B>::along(const DiscreteProblem<B>& problem, Index p, int k) const -> Row {
  double d[B] = {};
  const double* N = problem.frames.dual_at(p);
  for (int i = 0; i < B; ++i) d[i] = N ? N[i * B + k] : (i == k);
  return along(problem, p, d);
}

template <int D, int B>
Eigen::MatrixXd RigidMotions<D, B>::free(const DiscreteProblem<B>& problem) const {
  DecidingRows rows(count());
  if (axial_)
    for (int mode = 0; mode < count(); ++mode)
      if (mode != 1) rows.add(Row::Unit(count(), mode));
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) {
        rows.add(along(problem, static_cast<Index>(p), k));
        if (rows.complete()) return Eigen::MatrixXd(count(), 0);
      }
  return rows.null_space();
}

template <int D, int B>
auto RigidMotions<D, B>::nearest_to_prescribed(const DiscreteProblem<B>& problem) const -> Motion {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(count(), count());
  Motion h = Motion::Zero(count());
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) {
        const Row row = along(problem, static_cast<Index>(p), k);
        H += row.transpose() * row;
        h += problem.start[p * B + static_cast<std::size_t>(k)] * row.transpose();
      }
  if (h.isZero(0)) return h;
  return smallest_solution(H, h);
}

/// Of one body: its translations, then its rotations.
template <int D, int B>
auto RigidMotions<D, B>::part(const Motion& motion, std::size_t body) const -> One {
  constexpr int rotations = modes - translations;
  const auto number = static_cast<Eigen::Index>(body);
  One out;
  out.template head<translations>() = motion.segment(number * translations, translations);
  if constexpr (rotations > 0)
    out.template tail<rotations>() =
        motion.segment(static_cast<Eigen::Index>(bodies_.size()) * translations + number * rotations, rotations);
  return out;
}

template <int D, int B>
std::string RigidMotions<D, B>::at(const Body& body, const Point<D>& from_middle) const {
  Point<D> x;
  for (int i = 0; i < D; ++i) {
    x[i] = body.middle[i] + body.size * from_middle[i];
    if (std::abs(x[i]) <= 1e-9 * body.size) x[i] = 0;
  }
  return text(x);
}

/// As join() calls it, for messages; empty where the mesh does not know.
template <int D, int B>
std::string RigidMotions<D, B>::name_of(std::size_t body) const {
  const Mesh<D>& mesh = nodes_.mesh();
  for (const Part& part : mesh.parts) {
    const std::string name = body_of(part.name);
    if (name.empty() || part.faces.empty()) continue;
    const Index p = nodes_.of_vertex(mesh.boundary[part.faces.front()].vertices[0]);
    if (of_node_[p] == static_cast<Index>(body)) return fmt::format(" '{}'", name);
  }
  return "";
}

// Of several bodies those that do not move are left out.
template <int D, int B>
std::string RigidMotions<D, B>::describe(const Motion& motion) const {
  constexpr double still = 1e-9;
  if (bodies_.size() == 1) return describe(bodies_.front(), part(motion, 0));
  std::string out;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const One own = part(motion, body);
    if (!(own.norm() > still * motion.norm())) continue;
    out += fmt::format("{}{} of the body{} around {}", out.empty() ? "" : " with ", describe(bodies_[body], own),
                       name_of(body), at(bodies_[body], Point<D>{}));
  }
  return out;
}

// A rotation whose axis is a thousand times the size of the body off is the translation that it about is.
template <int D, int B>
std::string RigidMotions<D, B>::describe(const Body& body, const One& motion) const {
  constexpr double negligible = 1e-9, far_off = 2e3;  // in half sizes of the body
  if constexpr (B == 1) {
    return "the constant";
  } else {
    const Eigen::Matrix<double, D, 1> t = motion.template head<D>();
    const auto w = motion.template tail<modes - D>();
    if (far_off * w.norm() <= t.norm()) return "translation along " + text(t.normalized());
    if constexpr (D == 2) {
      return "rotation about " + at(body, {-t[1] / w[0], t[0] / w[0]});
    } else {
      const Point<3> axis{w[0] / w.norm(), w[1] / w.norm(), w[2] / w.norm()};
      Point<3> x = cross(axis, {t[0] / w.norm(), t[1] / w.norm(), t[2] / w.norm()});
      const double pitch = (t[0] * axis[0] + t[1] * axis[1] + t[2] * axis[2]) / w.norm();
      const std::string screw =
          std::abs(pitch) <= negligible ? "" : fmt::format(" and by {:.6g} per radian along it", pitch * body.size);
      return fmt::format("rotation about the axis through {} along {}{}", at(body, x), text(axis), screw);
    }
  }
}

template <int D, int B>
auto RigidMotions<D, B>::simple_basis(const Eigen::MatrixXd& space) const -> std::vector<Motion> {
  std::vector<Motion> out;
  const int shifting = translations * static_cast<int>(bodies_.size()), rotations = count() - shifting;
  const Eigen::MatrixXd none = null_space(space.bottomRows(rotations), rounding_of_bases);
  Eigen::MatrixXd shifts = space * none, turns = space * null_space(none.transpose(), rounding_of_bases);
  if (shifts.cols() > 0) {
    const Eigen::MatrixXd along = orthonormal_columns(shifts.topRows(shifting));
    if (turns.cols() > 0) turns.topRows(shifting) -= along * (along.transpose() * turns.topRows(shifting)).eval();
    reduce_columns(shifts, 0, shifting);
  }
  if (turns.cols() > 0) reduce_columns(turns, shifting, count());
  for (const Eigen::MatrixXd* part : {&shifts, &turns})
    for (Eigen::Index k = 0; k < part->cols(); ++k) out.push_back(part->col(k));
  return out;
}

template class RigidMotions<2, 1>;
template class RigidMotions<3, 1>;
template class RigidMotions<2, 2>;
template class RigidMotions<3, 3>;

}  // namespace signorini
