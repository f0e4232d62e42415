#pragma once
#include <optional>
#include <span>
#include <string>

#include "core/io/cairo/axis.hpp"
#include "core/io/cairo/sheet.hpp"

namespace signorini {

/// Where on a sheet a plot lies, in pixels.
struct Area {
  double left, top, width, height;
};

/// Lines over two axes.
class Plot {
 public:
  Plot(Sheet& sheet, const Area& area, Axis x, Axis y)
      : sheet_(sheet), area_(area), x_(std::move(x)), y_(std::move(y)) {}

  void grid();
  void x_axis(const std::string& label);
  void y_axis(const std::string& label);
  /// To the right of the plot.
  void second_axis(const std::string& label);
  /// Points that are not numbers interrupt the line.
  /// @param marker of the points, where they are few
  void curve(std::span<const std::array<double, 2>> points, std::optional<Marker> marker, const Stroke& stroke);
  /// The points alone.
  void marks(std::span<const std::array<double, 2>> points, Marker marker, const Stroke& stroke);

 private:
  Spot spot(double x, double y) const;
  double bottom() const { return area_.top + area_.height; }
  double right() const { return area_.left + area_.width; }

  Sheet& sheet_;
  Area area_;
  Axis x_, y_;
};

}  // namespace signorini
