#include "core/fem/rigid_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/fem/element.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-10;  // part of the largest one below which a singular value is zero

/// Rows, of which only what decides their null space is kept.
class Rows {
 public:
  explicit Rows(int columns) : columns_(columns), rows_(capacity, columns) {}

  void add(const Eigen::RowVectorXd& row) {
    rows_.row(used_++) = row;
    if (used_ == capacity) compress();
  }

  /// Whether they surely are linearly independent in all columns.
  bool complete() const { return complete_; }

  Eigen::MatrixXd null_space() const { return signorini::null_space(rows_.topRows(used_), rounding); }

 private:
  static constexpr Eigen::Index capacity = 64;
  static constexpr double surely = 1e-6;

  void compress() {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows_);
    const Eigen::MatrixXd R = qr.matrixQR().topRows(columns_).triangularView<Eigen::Upper>();
    rows_.topRows(columns_) = R;
    used_ = columns_;
    const auto values = Eigen::JacobiSVD<Eigen::MatrixXd>(R).singularValues();
    complete_ = values[columns_ - 1] > surely * values[0];
  }

  int columns_;
  Eigen::MatrixXd rows_;
  Eigen::Index used_ = 0;
  bool complete_ = false;
};

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

template <class Vector>
std::string text(const Vector& values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  std::string out;
  for (const double v : values)
    out += fmt::format("{}{:.6g}", out.empty() ? "" : ", ", std::abs(v) <= 1e-9 * largest ? 0.0 : v);
  return "(" + out + ")";
}

}  // namespace

Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows, double tolerance) {
  const Eigen::Index n = rows.cols();
  if (rows.rows() == 0 || n == 0) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::FullPivHouseholderQRPreconditioner> svd(rows, Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  const Eigen::Index rank = values[0] > 0 ? (values.array() > tolerance * values[0]).count() : 0;
  return svd.matrixV().rightCols(n - rank);
}

template <int D, int B>
RigidMotions<D, B>::RigidMotions(const Nodes<D>& nodes, Plane plane)
    : nodes_(nodes), axial_(B > 1 && plane == Plane::axisymmetric) {
  for (int i = 0; i < D; ++i) {
    const auto [low, high] =
        std::ranges::minmax(nodes.mesh().points, {}, [i](const Point<D>& x) { return x[static_cast<std::size_t>(i)]; });
    middle_[i] = 0.5 * (low[i] + high[i]);
    size_ = std::max(size_, 0.5 * (high[i] - low[i]));
  }
}

template <int D, int B>
auto RigidMotions<D, B>::along(Index p, const double* d) const -> Row {
  Row row = Row::Zero();
  if (axial_) {
    if constexpr (B > 1) row[1] = d[1];
    return row;
  }
  for (int i = 0; i < translations; ++i) row[i] = d[i];
  if constexpr (B > 1) {
    const Point<D> x = nodes_.control_point(p);
    Point<D> y;
    for (int i = 0; i < D; ++i) y[i] = (x[i] - middle_[i]) / size_;
    if constexpr (D == 2) row[2] = y[0] * d[1] - y[1] * d[0];
    if constexpr (D == 3)
      for (int i = 0; i < 3; ++i) row[3 + i] = y[(i + 1) % 3] * d[(i + 2) % 3] - y[(i + 2) % 3] * d[(i + 1) % 3];
  }
  return row;
}

template <int D, int B>
auto RigidMotions<D, B>::along(const Frames<B>& frames, Index p, int k) const -> Row {
  double d[B] = {};
  const double* N = frames.dual_at(p);
  for (int i = 0; i < B; ++i) d[i] = N ? N[i * B + k] : (i == k);
  return along(p, d);
}

template <int D, int B>
Eigen::MatrixXd RigidMotions<D, B>::free(const DiscreteProblem<B>& problem) const {
  Rows rows(modes);
  if (axial_)
    for (int mode = 0; mode < modes; ++mode)
      if (mode != 1) rows.add(Row::Unit(mode));
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) {
        rows.add(along(problem.frames, static_cast<Index>(p), k));
        if (rows.complete()) return Eigen::MatrixXd(modes, 0);
      }
  return rows.null_space();
}

template <int D, int B>
auto RigidMotions<D, B>::nearest_to_prescribed(const DiscreteProblem<B>& problem) const -> Motion {
  Eigen::Matrix<double, modes, modes> H = decltype(H)::Zero();
  Motion h = Motion::Zero();
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) {
        const Row row = along(problem.frames, static_cast<Index>(p), k);
        H += row.transpose() * row;
        h += problem.start[p * B + static_cast<std::size_t>(k)] * row.transpose();
      }
  if (h.isZero(0)) return h;
  return H.completeOrthogonalDecomposition().solve(h);
}

template <int D, int B>
std::string RigidMotions<D, B>::at(const Point<D>& from_middle) const {
  Point<D> x;
  for (int i = 0; i < D; ++i) {
    x[i] = middle_[i] + size_ * from_middle[i];
    if (std::abs(x[i]) <= 1e-9 * size_) x[i] = 0;
  }
  return text(x);
}

// A rotation whose axis is a thousand times the size of the body off is the translation that it about is.
template <int D, int B>
std::string RigidMotions<D, B>::describe(const Motion& motion) const {
  constexpr double negligible = 1e-9, far_off = 2e3;  // in half sizes of the body
  if constexpr (B == 1) {
    return "the constant";
  } else {
    const Eigen::Matrix<double, D, 1> t = motion.template head<D>();
    const auto w = motion.template tail<modes - D>();
    if (far_off * w.norm() <= t.norm()) return "translation along " + text(t.normalized());
    if constexpr (D == 2) {
      return "rotation about " + at({-t[1] / w[0], t[0] / w[0]});
    } else {
      const Point<3> axis{w[0] / w.norm(), w[1] / w.norm(), w[2] / w.norm()};
      Point<3> x = cross(axis, {t[0] / w.norm(), t[1] / w.norm(), t[2] / w.norm()});
      const double pitch = (t[0] * axis[0] + t[1] * axis[1] + t[2] * axis[2]) / w.norm();
      const std::string screw =
          std::abs(pitch) <= negligible ? "" : fmt::format(" and by {:.6g} per radian along it", pitch * size_);
      return fmt::format("rotation about the axis through {} along {}{}", at(x), text(axis), screw);
    }
  }
}

template <int D, int B>
auto RigidMotions<D, B>::simple_basis(const Eigen::MatrixXd& space) const -> std::vector<Motion> {
  std::vector<Motion> out;
  constexpr int rotations = modes - translations;
  const Eigen::MatrixXd none = null_space(space.bottomRows(rotations), rounding);
  Eigen::MatrixXd shifts = space * none, turns = space * null_space(none.transpose(), rounding);
  if (shifts.cols() > 0) {
    const Eigen::MatrixXd along = shifts.topRows(translations);
    if (turns.cols() > 0)
      turns.topRows(translations) -= along * along.householderQr().solve(turns.topRows(translations));
    reduce_columns(shifts, 0, translations);
  }
  if (turns.cols() > 0) reduce_columns(turns, translations, modes);
  for (const Eigen::MatrixXd* part : {&shifts, &turns})
    for (Eigen::Index k = 0; k < part->cols(); ++k) out.push_back(part->col(k));
  return out;
}

template class RigidMotions<2, 1>;
template class RigidMotions<3, 1>;
template class RigidMotions<2, 2>;
template class RigidMotions<3, 3>;

}  // namespace signorini
