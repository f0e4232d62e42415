#pragma once
#include <functional>
#include <optional>

#include "core/base/types.hpp"
#include "core/sdk/settings.hpp"

namespace signorini::geometry {

/// A function of points, positive outside of an obstacle and negative inside; NaN where it has no value.
class ImplicitFunction {
 public:
  using Value = std::function<double(const Point<3>&)>;

  /// @param scale about the size of what is described; differences are taken over a small part of it
  ImplicitFunction(Value value, int dimension, double scale)
      : value_(std::move(value)), dimension_(dimension), scale_(scale) {}

  double operator()(const Point<3>& x) const { return value_(x); }
  /// By central differences.
  Point<3> gradient(const Point<3>& x) const;
  /// The second derivative along two directions.
  double curvature(const Point<3>& x, const Point<3>& along, const Point<3>& across) const;
  int dimension() const { return dimension_; }
  double scale() const { return scale_; }
  /// Whether the gradient jumps within what differences are taken over.
  bool has_kink(const Point<3>& x) const;

 private:
  Value value_;
  int dimension_;
  double scale_;
};

/// The signed distance to the points where a function is zero, and its direction away from there. The function need
/// not grow by one per length, and may have kinks: its largest or smallest of several.
/// - A function that is the distance is believed: its value is returned as it is.
/// - The nearest point otherwise, by Newton's method for it and a multiplier, with steps that are shortened.
/// - Where that ends nowhere there is an edge or a corner: the nearest point of the half spaces that bound the obstacle
///   at points found so far, until the function is zero there.
/// Nothing where neither finds a point.
std::optional<Distance> distance_to_zeros(const ImplicitFunction& f, const Point<3>& x);

}  // namespace signorini::geometry
