#pragma once
#include <string>

#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// The user's size field made safe for a mesher: values are checked (Error(Exit::input) unless finite and positive),
/// cut at `ceiling`, the largest size that still resolves the shape, and counted, so that a field or a shape that would
/// never let the mesher end is an error instead.
template <int D>
class Sizing {
 public:
  /// `diameter` of the shape: sizes below 1e-6 of it are errors. `shape` names it in messages.
  Sizing(const Size<D>& size, double ceiling, double diameter, std::string shape);

  double operator()(const Point<D>& p) const;
  const std::string& shape() const { return shape_; }
  /// Bounds the number of evaluations from now on by the elements to be expected. Throws Error(Exit::input) when
  /// these are too many for memory, or for a mesh of 2e8 elements.
  void expect(double elements);

 private:
  const Size<D>& size_;
  double ceiling_, floor_;
  std::string shape_;
  double limit_ = 1e7;
  mutable double evaluations_ = 0;
};

/// Elements to be expected in a region of the given measure (area, volume) from size values at points spread over it.
template <int D>
double expected_elements(double measure, const std::vector<double>& sizes);

}  // namespace signorini::geometry
