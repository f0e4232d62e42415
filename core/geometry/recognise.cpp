#include "core/geometry/recognise.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/dense.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_fitted = 2000;  // that a shape is fitted to
constexpr int most_steps = 40;

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

template <int D>
Vector<D> vector(const Point<D>& p) {
  return Vector<D>(p.data());
}

template <int D>
Point<D> point(const Vector<D>& v) {
  Point<D> p;
  for (int k = 0; k < D; ++k) p[k] = v[k];
  return p;
}

/// Two unit vectors across a unit vector.
std::array<Vector<3>, 2> across(const Vector<3>& axis) {
  const Vector<3> u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

template <int D>
int numbers(const Curve<D>& curve) {
  using enum CurveKind;
  return curve.kind == round ? D + 1 : curve.kind == cylinder ? 5 : curve.kind == cone ? 6 : 7;
}

/// The curve with its numbers changed by so much.
template <int D>
Curve<D> changed(Curve<D> curve, const VectorXd& by) {
  using enum CurveKind;
  if constexpr (D == 3) {
    if (curve.kind != round) {
      const auto [u, v] = across(vector<3>(curve.axis));
      const bool line = curve.kind == cylinder;
      const Eigen::Index turn = line ? 2 : 3;
      const Vector<3> shift = line ? Vector<3>(by[0] * u + by[1] * v) : Vector<3>(by.head<3>());
      curve.center = point<3>(vector<3>(curve.center) + shift);
      curve.axis = point<3>((vector<3>(curve.axis) + by[turn] * u + by[turn + 1] * v).normalized());
      if (curve.kind != cone) curve.radius += by[turn + 2];
      if (curve.kind != cylinder) curve.second += by[by.size() - 1];
      return curve;
    }
  }
  for (int k = 0; k < D; ++k) curve.center[k] += by[k];
  curve.radius += by[D];
  return curve;
}

template <int D>
VectorXd residual(const Curve<D>& curve, std::span<const Point<D>> points) {
  VectorXd out(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto off = height<D>(curve, points[i]);
    out[static_cast<Eigen::Index>(i)] = off ? off->distance : 1;
  }
  return out;
}

/// By Gauss and Newton, steps halved where they do not pay. The points are about 1 in size.
/// @param first of the numbers that may change
template <int D>
Curve<D> fitted(Curve<D> curve, std::span<const Point<D>> points, int first = 0) {
  constexpr double step = 1e-6;
  const int n = numbers<D>(curve);
  VectorXd r = residual<D>(curve, points);
  for (int k = 0; k < most_steps; ++k) {
    MatrixXd slope(r.size(), n - first);
    for (int i = first; i < n; ++i) {
      VectorXd by = VectorXd::Zero(n);
      by[i] = step;
      slope.col(i - first) =
          (residual<D>(changed<D>(curve, by), points) - residual<D>(changed<D>(curve, VectorXd(-by)), points)) /
          (2 * step);
    }
    VectorXd by = VectorXd::Zero(n);
    by.tail(n - first) = -least_squares(slope, r).x;
    if (!by.allFinite()) return curve;
    bool better = false;
    for (int halving = 0; halving < 10 && !better; ++halving, by /= 2) {
      const Curve<D> next = changed<D>(curve, by);
      const VectorXd s = residual<D>(next, points);
      if (!(s.squaredNorm() < r.squaredNorm())) continue;
      better = true;
      curve = next;
      r = s;
    }
    if (!better || by.norm() < 1e-15) break;
  }
  return curve;
}

double most(const VectorXd& residual) { return residual.cwiseAbs().maxCoeff(); }

/// A point near a cone's tip is that if it may be, within `rounding`: beside the tip, on the cone's side, it is as
/// near.
template <int D>
Curve<D> with_point_as_tip(const Curve<D>& curve, std::span<const Point<D>> points, double rounding) {
  constexpr double near = 0.02;
  if (curve.kind != CurveKind::cone) return curve;
  const auto off = [&](const Point<D>& p) { return length<D>(difference<D>(p, curve.center)); };
  const Point<D>& tip = *std::ranges::min_element(points, {}, off);
  if (off(tip) > near) return curve;
  Curve<D> moved = curve;
  moved.center = tip;
  moved = fitted<D>(moved, points, D);
  const double now = most(residual<D>(moved, points));
  return now <= rounding || now < most(residual<D>(curve, points)) ? moved : curve;
}

/// |p|^2 = 2 c.p + k, by linear least squares (Kasa, 1976).
template <int D>
std::optional<Curve<D>> round_start(std::span<const Point<D>> points) {
  MatrixXd a(points.size(), D + 1);
  VectorXd b(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    a.row(row) << 2 * vector<D>(points[i]).transpose(), 1;
    b[row] = vector<D>(points[i]).squaredNorm();
  }
  const VectorXd x = least_squares(a, b).x;
  const double square = x[D] + x.head(D).squaredNorm();
  if (!(square > 0) || !x.allFinite()) return {};
  return Curve<D>{.center = point<D>(x.head(D)), .radius = std::sqrt(square)};
}

/// The direction that symmetric second moments are smallest in; nothing where they are not small there.
std::optional<Vector<3>> flat_direction(const Eigen::Matrix3d& moments) {
  constexpr double small = 0.05;
  const auto [values, directions] = eigenpairs(moments);
  if (!(values[0] <= small * values[2])) return {};
  return Vector<3>(directions.col(0));
}

/// Across all normals.
std::optional<Curve<3>> cylinder_start(std::span<const Point<3>> points, std::span<const Point<3>> normals) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Point<3>& n : normals) moments += vector<3>(n) * vector<3>(n).transpose();
  const auto axis = flat_direction(moments);
  if (!axis) return {};
  const auto [u, v] = across(*axis);
  std::vector<Point<2>> flat;
  for (const Point<3>& p : points) flat.push_back({vector<3>(p).dot(u), vector<3>(p).dot(v)});
  const auto circle = round_start<2>(flat);
  if (!circle) return {};
  return Curve<3>{.center = point<3>(circle->center[0] * u + circle->center[1] * v),
                  .radius = circle->radius,
                  .kind = Curve<3>::Kind::cylinder,
                  .axis = point<3>(*axis)};
}

/// The normals of a cone have one component along its axis; its tangent planes meet in the tip.
std::optional<Curve<3>> cone_start(std::span<const Point<3>> points, std::span<const Point<3>> normals) {
  Vector<3> mean = Vector<3>::Zero(), middle = Vector<3>::Zero();
  for (const Point<3>& n : normals) mean += vector<3>(n) / static_cast<double>(normals.size());
  for (const Point<3>& p : points) middle += vector<3>(p) / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero(), planes = Eigen::Matrix3d::Zero();
  Vector<3> right = Vector<3>::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<3> n = vector<3>(normals[i]);
    moments += (n - mean) * (n - mean).transpose();
    planes += n * n.transpose();
    right += n.dot(vector<3>(points[i])) * n;
  }
  const auto axis = flat_direction(moments);
  const Vector<3> tip = SymmetricFactors(planes).solve(right);
  if (!axis || !tip.allFinite()) return {};
  const Vector<3> inwards = (middle - tip).dot(*axis) < 0 ? Vector<3>(-*axis) : *axis;
  double angle = 0;
  for (const Point<3>& p : points) {
    const Vector<3> from = vector<3>(p) - tip;
    angle += std::atan2(from.cross(inwards).norm(), from.dot(inwards)) / static_cast<double>(points.size());
  }
  return Curve<3>{.center = point<3>(tip), .kind = Curve<3>::Kind::cone, .axis = point<3>(inwards), .second = angle};
}

/// The lines along the normals of a surface of revolution meet its axis: with the line's moment m = p x n and the
/// axis' direction a and moment b, m.a + n.b = 0.
std::optional<Curve<3>> torus_start(std::span<const Point<3>> points, std::span<const Point<3>> normals) {
  MatrixXd lines(points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<3> n = vector<3>(normals[i]), m = vector<3>(points[i]).cross(n);
    lines.row(static_cast<Eigen::Index>(i)) << m.transpose(), n.transpose();
  }
  const Eigenpairs found = eigenpairs(lines.transpose() * lines);
  const Eigen::Matrix<double, 6, 1> axis = found.vectors.col(0);
  const double size = axis.head<3>().norm();
  if (!(size > 1e-6)) return {};
  const Vector<3> a = axis.head<3>() / size, base = a.cross(Vector<3>(axis.tail<3>() / size));
  std::vector<Point<2>> section;
  for (const Point<3>& p : points) {
    const Vector<3> from = vector<3>(p) - base;
    section.push_back({from.cross(a).norm(), from.dot(a)});
  }
  const auto circle = round_start<2>(section);
  if (!circle) return {};
  return Curve<3>{.center = point<3>(base + circle->center[1] * a),
                  .radius = circle->radius,
                  .kind = Curve<3>::Kind::torus,
                  .axis = point<3>(a),
                  .second = circle->center[0]};
}

/// Evenly some of many.
template <int D>
std::vector<Point<D>> some(std::span<const Point<D>> all) {
  const std::size_t stride = (all.size() + most_fitted - 1) / most_fitted;
  std::vector<Point<D>> out;
  for (std::size_t i = 0; i < all.size(); i += stride) out.push_back(all[i]);
  return out;
}

/// Points moved to the origin and scaled to about 1.
template <int D>
struct Scaled {
  Point<D> origin{};
  double unit = 0;
  std::vector<Point<D>> points;

  explicit Scaled(std::span<const Point<D>> given) {
    for (const Point<D>& p : given)
      for (int k = 0; k < D; ++k) origin[k] += p[k] / static_cast<double>(given.size());
    for (const Point<D>& p : given) unit = std::max(unit, length<D>(difference<D>(p, origin)));
    for (const Point<D>& p : given) {
      Point<D>& q = points.emplace_back(difference<D>(p, origin));
      for (double& x : q) x /= unit;
    }
  }

  Curve<D> back(Curve<D> curve) const {
    for (int k = 0; k < D; ++k) curve.center[k] = origin[k] + unit * curve.center[k];
    curve.radius *= unit;
    if (curve.kind == Curve<D>::Kind::torus) curve.second *= unit;
    return curve;
  }
};

}  // namespace

template <int D>
std::optional<Recognised<D>> recognise(std::span<const Point<D>> points, std::span<const Point<D>> normals,
                                       double rounding, double tolerance) {
  if (points.size() < 4) return {};
  const Scaled<D> own(points);
  if (!(own.unit > 0)) return {};
  const std::vector<Point<D>> few = some<D>(own.points), few_normals = some<D>(normals);
  std::optional<Recognised<D>> best;
  const auto try_from = [&](const std::optional<Curve<D>>& start) {
    if (!start || (best && best->deviation <= rounding)) return;
    if (static_cast<int>(few.size()) <= numbers<D>(*start)) return;
    const Curve<D> curve = with_point_as_tip<D>(fitted<D>(*start, few), few, rounding / own.unit);
    const double deviation = own.unit * most(residual<D>(curve, own.points));
    const bool sound = curve.kind == Curve<D>::Kind::cone ? curve.second > 0 && curve.second < std::numbers::pi / 2
                                                          : curve.radius > 0 && curve.second >= 0;
    if (sound && deviation <= tolerance && (!best || deviation < best->deviation))
      best = Recognised<D>{own.back(curve), deviation};
  };
  if constexpr (D == 3) {
    try_from(cylinder_start(few, few_normals));
    try_from(cone_start(few, few_normals));
  }
  try_from(round_start<D>(few));
  if constexpr (D == 3) try_from(torus_start(few, few_normals));
  return best;
}

template std::optional<Recognised<2>> recognise<2>(std::span<const Point<2>>, std::span<const Point<2>>, double,
                                                   double);
template std::optional<Recognised<3>> recognise<3>(std::span<const Point<3>>, std::span<const Point<3>>, double,
                                                   double);

}  // namespace signorini::geometry
