#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/cgal/own_units.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// A mesher that does not come to its end.
class NoEnd : public ShapeError {
 public:
  using ShapeError::ShapeError;
};

/// The user's size field made safe for a mesher: values are checked (ShapeError unless finite and positive),
/// cut at `ceiling`, the largest size that still resolves the shape, and counted, so that a field or a shape that would
/// never let the mesher end is an error instead.
template <int D>
class Sizing {
 public:
  /// @param ceiling, diameter in the shape's own units, as the points asked for and the values; sizes below 1e-6 of the
  ///   diameter are errors
  /// @param units of the mesher in the user's
  /// @param shape names it in messages, which are in the user's units
  /// @param narrowest says where the shape is that, for messages; "" if unknown
  Sizing(const Size<D>& size, double ceiling, double diameter, const OwnUnits<D>& units, std::string shape,
         std::string narrowest = "");

  double operator()(const Point<D>& p) const;
  /// The same, but not cut; rounded to six decimal digits, so that it is the same in all units, see own_units.hpp.
  double asked(Point<D> p) const;
  /// Lets the size field end the work, as it does when the user interrupts; for phases that need no sizes.
  void poll() const { size_(last_); }
  /// Counts a question that the mesher asks of the domain; polls every few of them. Throws NoEnd when they get too
  /// many.
  void count_query() const;
  /// Bounds the numbers of evaluations, queries and vertices from now on by the elements to be expected. Throws
  /// ShapeError when these are too many for memory, or for a mesh of 2e8 elements.
  void expect(double elements);
  /// Halves the sizes within a distance of a point, in the shape's own units.
  void halve_near(const Point<D>& p, double distance) { halved_.push_back({p, distance}); }
  /// The mesher has to give up at so many vertices.
  std::size_t most_vertices() const { return most_vertices_; }
  /// Throws NoEnd: too many evaluations, or a failure that has the same cause.
  /// @param place where that is, in the shape's own units
  [[noreturn]] void no_end(const std::optional<Point<D>>& place = {}) const;
  /// Throws ShapeError when the shape is so thin that it takes very many elements wherever the sizes asked for until
  /// now are larger than it.
  void check_thickness(double measure) const;

 private:
  [[noreturn]] void fail(const std::string& complaint) const;

  const Size<D>& size_;
  double ceiling_, floor_;
  OwnUnits<D> units_;
  std::string shape_, narrowest_;
  struct Halved {
    Point<D> center;
    double distance;
  };
  std::vector<Halved> halved_;
  mutable Point<D> last_{};
  double limit_ = 1e7, query_limit_ = 1e7;
  std::size_t most_vertices_ = 0;
  mutable double evaluations_ = 0, queries_ = 0, smallest_ = infinity;
};

/// Elements to be expected in a region of the given measure (area, volume) from size values at points spread over it.
template <int D>
double expected_elements(double measure, const std::vector<double>& sizes);

}  // namespace signorini::geometry
