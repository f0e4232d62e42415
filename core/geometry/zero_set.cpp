#include "core/geometry/zero_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/geometry/vector.hpp"

namespace signorini::geometry {
namespace {

const double first_step = std::cbrt(std::numeric_limits<double>::epsilon());  // balances truncation and rounding
const double second_step = std::sqrt(std::sqrt(std::numeric_limits<double>::epsilon()));
constexpr double believed = 1e-8;          // of a function's value: what is left at the point that it says is nearest
constexpr double at_zero = 1e-11;          // of the distance: the same of a point that was found, and
constexpr double off_normal = 1e-8;        // how far it is off the normal; the distance is off by the square of that
constexpr double at_corner = 1e-9;         // likewise, of the scale, where differences are taken across edges
constexpr double rounding = 1e-13;         // of the scale
constexpr double kink_of_gradient = 1e-2;  // of the gradient
constexpr double least_bowl = 0.1;         // of the identity: below that a stationary point may be a farthest one
constexpr double independent = 1e-10;      // pivot of unit vectors' products
constexpr int most_steps_there = 60, most_halvings = 12;
constexpr std::size_t most_planes = 14;

/// A function at a point: its value as a length, and the unit vector along which it grows.
struct Local {
  Point<3> at, normal;
  double distance = 0, slope = 0;
  bool ok() const { return std::isfinite(distance) && slope > 0 && std::isfinite(slope); }
};

Local local(const ImplicitFunction& f, const Point<3>& at) {
  Local out{.at = at, .normal = f.gradient(at)};
  out.slope = norm(out.normal);
  out.distance = f(at) / out.slope;
  for (double& n : out.normal) n /= out.slope;
  return out;
}

/// Directions across a unit vector, within the space.
std::vector<Point<3>> tangents(const Point<3>& n, int dimension) {
  if (dimension == 2) return {{-n[1], n[0], 0}};
  const auto k = static_cast<std::size_t>(
      std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - n.begin());
  Point<3> a{};
  a[k] = 1;
  a = cross(n, a);
  const double length = norm(a);
  for (double& c : a) c /= length;
  return {a, cross(n, a)};
}

/// The search for the nearest zero from one point.
class Search {
 public:
  Search(const ImplicitFunction& f, const Point<3>& x) : f_(f), x_(x), outside_(f(x) > 0 ? 1 : -1) {}

  /// Newton's method from some point; nothing where it ends nowhere.
  std::optional<Distance> newton(const Point<3>& start) const {
    Local y = local(f_, start);
    for (int k = 0; k < most_steps_there && y.ok(); ++k) {
      const Point<3> to = minus(x_, y.at);
      const double along = dot(to, y.normal), far = norm(to);
      const Point<3> off = plus(to, -along, y.normal);
      const double small = rounding * f_.scale();
      if (std::abs(y.distance) <= at_zero * far + small && norm(off) <= off_normal * far + small && faces(y))
        return result(y.at, y.normal);
      const std::optional<Local> next = shortened(y, step(y, along, off));
      if (!next) return {};
      y = *next;
    }
    return {};
  }

  /// The nearest point of half spaces, each of which bounds the obstacle where it was found.
  std::optional<Distance> corner() const {
    std::vector<Local> planes;
    add(local(f_, x_), planes);
    for (int k = 0; k < most_steps_there; ++k) {
      if (planes.empty() || !std::ranges::all_of(planes, [](const Local& plane) { return plane.ok(); })) return {};
      const std::optional<Point<3>> z = nearest(planes);
      if (!z) return {};
      const Local here = local(f_, *z);
      const double far = norm(minus(x_, *z));
      if (std::abs(here.distance) <= at_corner * f_.scale() || (!here.ok() && f_(*z) == 0 && far > 0))
        return result(*z, here.normal);
      add(here, planes);
    }
    return {};
  }

  /// Gradients within a kink belong to no piece; those of the pieces are found beside it.
  std::vector<Point<3>> beside(const Point<3>& x) const {
    std::vector<Point<3>> out;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f_.dimension()); ++k)
      for (const double sign : {1.0, -1.0}) {
        out.push_back(x);
        out.back()[k] += sign * 3 * first_step * f_.scale();
      }
    return out;
  }

 private:
  void add(const Local& here, std::vector<Local>& planes) const {
    if (f_.has_kink(here.at))
      for (const Point<3>& y : beside(here.at)) {
        if (!f_.has_kink(y)) planes.push_back(local(f_, y));
      }
    else
      planes.push_back(here);
    if (planes.size() > most_planes)
      planes.erase(planes.begin(), planes.end() - static_cast<std::ptrdiff_t>(most_planes));
  }

  /// Whether a zero is passed on the way out of the obstacle, not into it.
  bool faces(const Local& y) const {
    return outside_ * dot(minus(x_, y.at), y.normal) >= -off_normal * norm(minus(x_, y.at)) - rounding * f_.scale();
  }

  Distance result(const Point<3>& y, Point<3> normal) const {
    const Point<3> to = minus(x_, y);
    const double far = norm(to);
    if (far > first_step * f_.scale())
      for (int i = 0; i < 3; ++i) normal[i] = outside_ * to[i] / far;
    return {outside_ * far, {normal[0], normal[1], normal[2]}};
  }

  /// Along the normal to where the function would be zero, across it to the stationary point of
  /// |y - x|^2 / 2 + multiplier f(y).
  Point<3> step(const Local& y, double along, const Point<3>& off) const {
    const double multiplier = along / y.slope;
    const std::vector<Point<3>> t = tangents(y.normal, f_.dimension());
    const auto n = static_cast<Eigen::Index>(t.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = dot(off, t[i]);
      for (Eigen::Index j = 0; j <= i; ++j) H(j, i) = H(i, j) = H(i, j) + multiplier * f_.curvature(y.at, t[i], t[j]);
    }
    Point<3> out = plus({}, -y.distance, y.normal);
    if (!H.allFinite()) H.setIdentity();
    const Eigenpairs pairs = eigenpairs(H);
    const Eigen::VectorXd c = pairs.vectors.transpose() * r;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double bowl = pairs.values[k] > least_bowl ? pairs.values[k] : 1;
      for (Eigen::Index i = 0; i < n; ++i) out = plus(out, c[k] / bowl * pairs.vectors(i, k), t[i]);
    }
    return out;
  }

  /// The next point: where half the squared distance, and more than what the function's value is worth, is less.
  std::optional<Local> shortened(const Local& y, const Point<3>& step) const {
    const double worth = 2 * (norm(minus(x_, y.at)) + norm(step)) / y.slope;
    const auto merit = [&](const Local& z) {
      const Point<3> to = minus(x_, z.at);
      return dot(to, to) / 2 + worth * std::abs(z.distance * z.slope);
    };
    double part = 1;
    for (int k = 0; k < most_halvings; ++k, part /= 2) {
      const Local next = local(f_, plus(y.at, part, step));
      if (next.ok() && faces(next) && merit(next) <= merit(y) * (1 + believed)) return next;
    }
    return {};
  }

  /// Of points where none of the planes says that the function is positive.
  std::optional<Point<3>> nearest(const std::vector<Local>& planes) const {
    std::optional<Point<3>> best;
    const auto consider = [&](const std::vector<std::size_t>& some) {
      const std::optional<Point<3>> z = projected(planes, some);
      if (!z || (best && norm(minus(x_, *z)) >= norm(minus(x_, *best)))) return;
      const double slack = at_zero * norm(minus(x_, *z)) + rounding * f_.scale();
      if (std::ranges::all_of(planes, [&](const Local& p) {
            return outside_ * (p.distance + dot(p.normal, minus(*z, p.at))) <= slack;
          }))
        best = z;
    };
    for (std::size_t i = 0; i < planes.size(); ++i) {
      consider({i});
      for (std::size_t j = 0; j < i; ++j) {
        consider({i, j});
        for (std::size_t k = 0; k < j && f_.dimension() == 3; ++k) consider({i, j, k});
      }
    }
    return best;
  }

  /// Onto what some planes have in common.
  std::optional<Point<3>> projected(const std::vector<Local>& planes, const std::vector<std::size_t>& some) const {
    const auto n = static_cast<Eigen::Index>(some.size());
    Eigen::MatrixXd G(n, n);
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Local& p = planes[some[i]];
      r[i] = p.distance + dot(p.normal, minus(x_, p.at));
      for (Eigen::Index j = 0; j < n; ++j) G(i, j) = dot(p.normal, planes[some[j]].normal);
    }
    const auto [c, rank, range] = least_squares(G, r, independent);
    if (rank < n) return {};
    Point<3> out = x_;
    for (Eigen::Index i = 0; i < n; ++i) out = plus(out, -c[i], planes[some[i]].normal);
    return out;
  }

  const ImplicitFunction& f_;
  const Point<3> x_;
  const double outside_;
};

void take_nearer(std::optional<Distance>& best, const std::optional<Distance>& other) {
  if (other && (!best || std::abs(other->value) < std::abs(best->value))) best = other;
}

}  // namespace

Point<3> ImplicitFunction::gradient(const Point<3>& x) const {
  Point<3> g{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    Point<3> left = x, right = x;
    left[k] -= first_step * scale_;
    right[k] += first_step * scale_;
    g[k] = (value_(right) - value_(left)) / (right[k] - left[k]);
  }
  return g;
}

double ImplicitFunction::curvature(const Point<3>& x, const Point<3>& along, const Point<3>& across) const {
  const double h = second_step * scale_;
  const auto at = [&](double a, double b) { return value_(plus(plus(x, a * h, along), b * h, across)); };
  if (along == across) return (at(1, 0) - 2 * value_(x) + at(-1, 0)) / (h * h);
  return (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * h);
}

bool ImplicitFunction::has_kink(const Point<3>& x) const {
  const double h = first_step * scale_, here = value_(x), steepest = norm(gradient(x));
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    Point<3> left = x, right = x;
    left[k] -= h;
    right[k] += h;
    if (std::abs(value_(left) - 2 * here + value_(right)) > kink_of_gradient * h * steepest) return true;
  }
  return false;
}

std::optional<Distance> distance_to_zeros(const ImplicitFunction& f, const Point<3>& x) {
  const Local here = local(f, x);
  if (!here.ok()) return {};
  const double value = f(x);
  const Distance own{value, {here.normal[0], here.normal[1], here.normal[2]}};
  const bool kinked = f.has_kink(x);
  if (!kinked && std::abs(f(plus(x, -value, here.normal))) <= believed * std::abs(value)) return own;
  const Search search(f, x);
  std::optional<Distance> best;
  if (kinked)
    for (const Point<3>& start : search.beside(x)) take_nearer(best, search.newton(start));
  take_nearer(best, search.newton(x));
  bool smooth = best.has_value();
  if (best) {
    Point<3> foot = x;
    for (int i = 0; i < 3; ++i) foot[i] -= best->value * best->normal[i];
    smooth = !f.has_kink(foot);
  }
  if (!smooth)
    if (const std::optional<Distance> corner = search.corner()) return corner;
  return best;
}

}  // namespace signorini::geometry
