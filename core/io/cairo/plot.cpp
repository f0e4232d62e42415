#include "core/io/cairo/plot.hpp"

#include <cmath>
#include <vector>

namespace signorini {
namespace {
constexpr Stroke faint{{0xdd, 0xdd, 0xdd}, 1, false};
constexpr std::size_t marks_up_to = 60;  ///< curves of more points have none
constexpr double tick_length = 5, tick_gap = 9, label_gap = 78;
}  // namespace

Spot Plot::spot(double x, double y) const {
  return {area_.left + area_.width * (x - x_.low) / (x_.high - x_.low),
          bottom() - area_.height * (y - y_.low) / (y_.high - y_.low)};
}

void Plot::grid() {
  for (const Tick& tick : x_.ticks) sheet_.line(spot(tick.at, y_.low), spot(tick.at, y_.high), faint);
  for (const Tick& tick : y_.ticks) sheet_.line(spot(x_.low, tick.at), spot(x_.high, tick.at), faint);
}

void Plot::x_axis(const std::string& label) {
  sheet_.line({area_.left, bottom()}, {right(), bottom()}, {});
  for (const Tick& tick : x_.ticks) {
    const Spot at = spot(tick.at, y_.low);
    sheet_.line(at, {at.x, at.y - tick_length}, {});
    sheet_.text({at.x, at.y + tick_gap}, tick.text, {0.5, 1}, tick.power);
  }
  sheet_.text({area_.left + area_.width / 2, bottom() + 32}, label, {0.5, 1});
}

void Plot::y_axis(const std::string& label) {
  sheet_.line({area_.left, area_.top}, {area_.left, bottom()}, {});
  for (const Tick& tick : y_.ticks) {
    const Spot at = spot(x_.low, tick.at);
    sheet_.line(at, {at.x + tick_length, at.y}, {});
    sheet_.text({at.x - tick_gap, at.y}, tick.text, {1, 0.5}, tick.power);
  }
  sheet_.text({area_.left - label_gap, area_.top + area_.height / 2}, label, {0.5, 0.5, true});
}

void Plot::second_axis(const std::string& label) {
  sheet_.line({right(), area_.top}, {right(), bottom()}, {});
  for (const Tick& tick : y_.ticks) {
    const Spot at = spot(x_.high, tick.at);
    sheet_.line(at, {at.x - tick_length, at.y}, {});
    sheet_.text({at.x + tick_gap, at.y}, tick.text, {0, 0.5}, tick.power);
  }
  sheet_.text({right() + label_gap, area_.top + area_.height / 2}, label, {0.5, 0.5, true});
}

void Plot::marks(std::span<const std::array<double, 2>> points, Marker marker, const Stroke& stroke) {
  for (const auto& [x, y] : points)
    if (std::isfinite(x) && std::isfinite(y)) sheet_.mark(spot(x, y), marker, stroke);
}

void Plot::curve(std::span<const std::array<double, 2>> points, std::optional<Marker> marker, const Stroke& stroke) {
  std::vector<Spot> line;
  const auto end_line = [&] {
    sheet_.polyline(line, stroke);
    if (marker && (points.size() <= marks_up_to || line.size() == 1))
      for (const Spot& at : line) sheet_.mark(at, *marker, stroke);
    line.clear();
  };
  for (const auto& [x, y] : points)
    if (std::isfinite(x) && std::isfinite(y))
      line.push_back(spot(x, y));
    else
      end_line();
  end_line();
}

}  // namespace signorini
