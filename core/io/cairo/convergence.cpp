#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/cairo/painter.hpp"
#include "core/io/cairo/plot.hpp"

namespace signorini {
namespace {

using Curve = std::vector<std::array<double, 2>>;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int width = 900, height = 600;
constexpr Area area{95, 25, 710, 465};
constexpr Stroke residuals{{0x21, 0x66, 0xac}, 2}, errors{{0xb2, 0x18, 0x2b}, 2}, nodes{{0x88, 0x88, 0x88}, 1, true};

/// Zero and infinity cannot be drawn on a logarithmic axis.
double logarithm(double value) { return value > 0 && std::isfinite(value) ? std::log10(value) : nothing; }

template <class Value>
Curve curve(const std::vector<IterationRecord>& history, Value value) {
  Curve points;
  for (const IterationRecord& record : history)
    points.push_back({static_cast<double>(record.iteration), static_cast<double>(value(record))});
  return points;
}

/// Around all that is drawn of two curves.
Axis axis_of(const Curve& a, const Curve& b) {
  double low = infinity, high = -infinity;
  for (const Curve* points : {&a, &b})
    for (const auto& [x, y] : *points)
      if (!std::isnan(y)) low = std::min(low, y), high = std::max(high, y);
  return low <= high ? logarithmic_axis(low, high) : logarithmic_axis(-16, 0);
}

void key(Sheet& sheet, double x, const char* text, Marker marker, const Stroke& stroke) {
  constexpr double y = height - 30, length = 40;
  sheet.line({x, y}, {x + length, y}, stroke);
  sheet.mark({x + length / 2, y}, marker, stroke);
  sheet.text({x + length + 8, y}, text, {0, 0.5});
}

}  // namespace

void draw_convergence(const std::filesystem::path& picture, const std::vector<IterationRecord>& history) {
  const Curve residual = curve(history, [](const IterationRecord& record) { return logarithm(record.residual); });
  const Curve error = curve(history, [](const IterationRecord& record) { return logarithm(record.algebraic_error); });
  const Curve contact = curve(history, [](const IterationRecord& record) { return record.contact_nodes; });
  double last = 1, most = 1;
  for (const IterationRecord& record : history) {
    last = std::max(last, static_cast<double>(record.iteration));
    most = std::max(most, static_cast<double>(record.contact_nodes));
  }
  Sheet sheet(width, height, picture);
  const Axis iterations = linear_axis(0.5, last + 0.5, 1);
  Plot plot(sheet, area, iterations, axis_of(residual, error));
  Plot counts(sheet, area, iterations, widened_axis(0, most, 1));
  plot.grid();
  sheet.frame({area.left, area.top}, area.width, area.height);
  counts.curve(contact, Marker::circle, nodes);
  plot.curve(residual, Marker::disk, residuals);
  plot.curve(error, Marker::square, errors);
  plot.x_axis("iteration");
  plot.y_axis("relative to the solution");
  counts.second_axis("nodes in contact");
  key(sheet, 130, "natural residual", Marker::disk, residuals);
  key(sheet, 370, "algebraic error", Marker::square, errors);
  key(sheet, 600, "nodes in contact", Marker::circle, nodes);
  sheet.write();
}

}  // namespace signorini
