#include "core/geometry/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/types.hpp"

namespace signorini::geometry {

namespace {

using Components = std::vector<Field>;

double norm(const Point<3>& a) { return std::hypot(a[0], a[1], a[2]); }
Point<3> scaled(double s, const Point<3>& a) { return {s * a[0], s * a[1], s * a[2]}; }
Point<3> minus(const Point<3>& a, const Point<3>& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

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

Point<3> gradient(const Field& distance, const Site& site, int dimension, double step) {
  Point<3> g{};
  for (int k = 0; k < dimension; ++k) {
    Site left = site, right = site;
    left.x[k] -= step;
    right.x[k] += step;
    g[static_cast<std::size_t>(k)] = (distance(right) - distance(left)) / (right.x[k] - left.x[k]);
  }
  return g;
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

std::unique_ptr<DistanceFunction> expression(const Field& distance, const Components& normal, int dimension,
                                             double length, double t, const std::string& origin) {
  if (!normal.empty() && constant(normal)) direction(normal, {}, "normal", origin);
  const double relative_step = std::cbrt(std::numeric_limits<double>::epsilon());  // balances truncation and rounding
  return std::make_unique<Shape>(
      [=](const Site& site) -> Distance {
        const double d = distance(site);
        Point<3> n;
        if (normal.empty()) {
          double scale = length;
          if (scale == 0)
            scale = std::max({std::abs(site.x[0]), std::abs(site.x[1]), std::abs(site.x[2]), std::abs(d)});
          const Point<3> g = gradient(distance, site, dimension, relative_step * (scale > 0 ? scale : 1));
          if (norm(g) == 0)
            input_error(origin, fmt::format("distance: the gradient of '{}' at [{:g}, {:g}, {:g}] is zero, expected a "
                                            "distance that grows away from the obstacle, or a 'normal'",
                                            distance.text(), site.x[0], site.x[1], site.x[2]));
          n = scaled(1 / norm(g), g);
        } else {
          n = direction(normal, site, "normal", origin);
        }
        return {d, {n[0], n[1], n[2]}};
      },
      t);
}

}  // namespace signorini::geometry
