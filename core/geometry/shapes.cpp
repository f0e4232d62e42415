#include "core/geometry/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/base/types.hpp"
#include "core/geometry/vector.hpp"
#include "core/geometry/zero_set.hpp"

namespace signorini::geometry {

namespace {

using Components = std::vector<Field>;

constexpr double word = 1e-6;      // of one: how far slopes that are meant to be one or zero may be off
constexpr double settled = 1e-12;  // of a distance: the last step towards it
constexpr int most_newton_steps = 60;

/// The parameters of a shape at a site, and what its distance is there.
using Evaluation = std::function<Distance(const Site&)>;

using Place = std::function<Placement(const Site&)>;

class Shape : public DistanceFunction {
 public:
  Shape(Evaluation evaluation, double t, Place place = {})
      : evaluation_(std::move(evaluation)), place_(std::move(place)), t_(t) {}

  void place(const double* point, const double* normal, Placement& out, Status& status) const noexcept override {
    if (!place_) return;
    try {
      out = place_(site(point, normal));
      return;
    } catch (const Error& error) {
      status.fail(static_cast<int>(error.status()), error.what());
    } catch (const std::exception& error) {
      status.fail(static_cast<int>(Exit::input), error.what());
    }
  }

  Distance at(const double* point, const double* normal, Status& status) const noexcept override {
    try {
      // Checked first: the library's hypot of three numbers loses a NaN.
      if (!std::all_of(point, point + 3, [](double x) { return std::isfinite(x); }))
        input_error("point", "the distance to the obstacle was asked for at a point that is not finite");
      const Distance d = evaluation_(site(point, normal));
      if (std::isfinite(d.value + d.normal[0] + d.normal[1] + d.normal[2])) return d;
      status.fail(static_cast<int>(Exit::input), "the distance to the obstacle is not finite");
    } catch (const Error& error) {
      status.fail(static_cast<int>(error.status()), error.what());
    } catch (const std::exception& error) {
      status.fail(static_cast<int>(Exit::input), error.what());
    }
    return {};
  }

 private:
  Site site(const double* point, const double* normal) const {
    Site out;
    std::copy_n(point, 3, out.x);
    std::copy_n(normal, 3, out.n);
    out.t = t_;
    return out;
  }

  Evaluation evaluation_;
  Place place_;
  double t_;
};

Placement placement(const Point<3>& origin, const Point<3>& axis = {}) {
  return {{origin[0], origin[1], origin[2]}, {axis[0], axis[1], axis[2]}};
}

Point<3> value(const Components& fields, const Site& site) {
  Point<3> v{};
  for (std::size_t k = 0; k < std::min<std::size_t>(fields.size(), 3); ++k) v[k] = fields[k](site);
  return v;
}

Point<3> direction(const Components& fields, const Site& site, const char* key, const std::string& origin) {
  Point<3> v = value(fields, site);
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (largest == 0) input_error(origin, fmt::format("{}: found a zero vector, expected a direction", key));
  v = scaled(1 / largest, v);
  return scaled(1 / norm(v), v);
}

double positive(const Field& field, const Site& site, const char* key, const std::string& origin) {
  const double v = field(site);
  if (v <= 0) input_error(origin, fmt::format("{}: found {:g}, expected a positive number", key, v));
  return v;
}

bool constant(const Components& fields) {
  return std::ranges::all_of(fields, [](const Field& f) { return f.constant().has_value(); });
}

/// Distance to a round obstacle from the offset to its centre or axis; `fallback` is the normal where that is zero.
Distance radial(const Point<3>& offset, double radius, bool inside, const Point<3>& fallback) {
  const double r = norm(offset), sign = inside ? -1 : 1;
  const Point<3> n = r > 0 ? scaled(sign / r, offset) : scaled(sign, fallback);
  return {sign * (r - radius), {n[0], n[1], n[2]}};
}

/// Some unit vector orthogonal to a unit vector.
Point<3> orthogonal(const Point<3>& a) {
  const auto k = static_cast<std::size_t>(
      std::min_element(a.begin(), a.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }) - a.begin());
  Point<3> v = scaled(-a[k], a);
  v[k] += 1;
  return scaled(1 / norm(v), v);
}

/// A function that the user wrote, around a point; what it has no value at is no error.
ImplicitFunction around(const Field& distance, const Site& site, int dimension, double scale) {
  return {[&distance, site](const Point<3>& x) {
            Site there = site;
            std::copy_n(x.data(), 3, there.x);
            try {
              return distance(there);
            } catch (const Error&) {
              return std::numeric_limits<double>::quiet_NaN();
            }
          },
          dimension, scale};
}

/// How far to look: the larger of the point's coordinates and its distance, which is a length once it is divided by the
/// gradient.
ImplicitFunction around(const Field& distance, const Site& site, int dimension) {
  const double value = std::abs(distance(site)), far = norm({site.x[0], site.x[1], site.x[2]});
  const double first = std::max(far, value) > 0 ? std::max(far, value) : 1;
  const double slope = norm(around(distance, site, dimension, first).gradient({site.x[0], site.x[1], site.x[2]}));
  const double better = std::max(far, value / slope);
  return around(distance, site, dimension, std::isfinite(better) && better > 0 ? better : first);
}

[[noreturn]] void no_distance(const Field& distance, const Site& site, const Point<3>& gradient,
                              const std::string& origin) {
  const std::string where = fmt::format("'{}' at [{:g}, {:g}, {:g}]", distance.text(), site.x[0], site.x[1], site.x[2]);
  if (norm(gradient) == 0)
    input_error(origin,
                fmt::format("distance: the gradient of {} is zero, expected a distance that grows away from the "
                            "obstacle, or a 'normal'",
                            where));
  input_error(origin,
              fmt::format("distance: {} is no distance: it is {:g}, its gradient has length {:g}, and no nearest "
                          "point where it is zero was found; expected a distance, or a function that is zero "
                          "on the surface of the obstacle alone",
                          where, distance(site), norm(gradient)));
}

/// How far a point is from where the function is zero on the line along n.
double along_normal(const ImplicitFunction& f, const Point<3>& x, const Point<3>& n) {
  const auto at = [&](double s) { return f({x[0] - s * n[0], x[1] - s * n[1], x[2] - s * n[2]}); };
  const double rounding = rounding_of_differences * norm(x);  // a sum that cancels leaves that
  double s = 0;
  for (int k = 0; k < most_newton_steps; ++k) {
    const Point<3> here{x[0] - s * n[0], x[1] - s * n[1], x[2] - s * n[2]};
    const double step = at(s) / dot(f.gradient(here), n);
    if (!std::isfinite(step)) break;
    s += step;
    if (std::abs(step) <= std::max(settled * std::abs(s), rounding)) return s;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// With a normal that the user wrote: the value is believed where it grows by one per length along it, or not at all,
/// as one that is given over the body's surface, or where it is the distance to the nearest point.
std::optional<double> distance_along(const ImplicitFunction& f, const Point<3>& x, const Point<3>& n) {
  const Point<3> g = f.gradient(x);
  const double value = f(x), slope = dot(g, n), steepest = norm(g);
  const bool grows = std::abs(slope) > word * steepest, by_one = std::abs(slope - 1) <= word;
  if (!std::isfinite(steepest) || !grows || by_one) return value;
  const double step = value / steepest;
  if (std::abs(f({x[0] - step * g[0], x[1] - step * g[1], x[2] - step * g[2]})) <= word * std::abs(value) &&
      std::abs(steepest - 1) <= word)
    return value;
  const double s = along_normal(f, x, n);
  return std::isfinite(s) ? std::optional(s) : std::nullopt;
}

}  // namespace

std::unique_ptr<DistanceFunction> plane(const Components& point, const Components& normal, double t,
                                        const std::string& origin) {
  if (constant(normal)) direction(normal, {}, "normal", origin);
  return std::make_unique<Shape>(
      [=](const Site& site) -> Distance {
        const Point<3> n = direction(normal, site, "normal", origin);
        return {dot(minus({site.x[0], site.x[1], site.x[2]}, value(point, site)), n), {n[0], n[1], n[2]}};
      },
      t, [=](const Site& site) { return placement(value(point, site), direction(normal, site, "normal", origin)); });
}

std::unique_ptr<DistanceFunction> sphere(const Components& center, const Field& radius, bool inside, double t,
                                         const std::string& origin) {
  if (radius.constant()) positive(radius, {}, "radius", origin);
  return std::make_unique<Shape>(
      [=](const Site& site) {
        const Point<3> offset = minus({site.x[0], site.x[1], site.x[2]}, value(center, site));
        return radial(offset, positive(radius, site, "radius", origin), inside, {1, 0, 0});
      },
      t, [=](const Site& site) { return placement(value(center, site)); });
}

std::unique_ptr<DistanceFunction> cylinder(const Components& center, const Components& axis, const Field& radius,
                                           bool inside, double t, const std::string& origin) {
  if (radius.constant()) positive(radius, {}, "radius", origin);
  if (constant(axis)) direction(axis, {}, "axis", origin);
  return std::make_unique<Shape>(
      [=](const Site& site) {
        const Point<3> a = direction(axis, site, "axis", origin);
        Point<3> offset = minus({site.x[0], site.x[1], site.x[2]}, value(center, site));
        offset = minus(offset, scaled(dot(offset, a), a));
        return radial(offset, positive(radius, site, "radius", origin), inside, orthogonal(a));
      },
      t, [=](const Site& site) { return placement(value(center, site), direction(axis, site, "axis", origin)); });
}

std::unique_ptr<DistanceFunction> expression(const Field& distance, const Components& normal, int dimension, double t,
                                             const std::string& origin) {
  if (!normal.empty() && constant(normal)) direction(normal, {}, "normal", origin);
  return std::make_unique<Shape>(
      [=](const Site& site) -> Distance {
        const Point<3> x{site.x[0], site.x[1], site.x[2]};
        const ImplicitFunction f = around(distance, site, dimension);
        if (normal.empty()) {
          if (const std::optional<Distance> found = distance_to_zeros(f, x)) return *found;
        } else {
          const Point<3> n = direction(normal, site, "normal", origin);
          if (const std::optional<double> d = distance_along(f, x, n)) return {*d, {n[0], n[1], n[2]}};
        }
        no_distance(distance, site, f.gradient(x), origin);
      },
      t);
}

}  // namespace signorini::geometry
