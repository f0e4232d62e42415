#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/io/cairo/painter.hpp"
#include "core/io/cairo/plot.hpp"
#include "core/io/raster.hpp"

namespace signorini {
namespace {
constexpr int panel_width = 640, panel_height = 560, raster_size = 450;
constexpr Area figure{30, 60, raster_size, raster_size};  // of a panel

constexpr Area palette_area{505, 85, 20, 400};

/// The legend of the colours.
void draw_palette(Sheet& sheet, double left, const std::string& label, const ColourRange& range) {
  const Area area{left + palette_area.left, palette_area.top, palette_area.width, palette_area.height};
  for (int row = 0; row < area.height; ++row)
    sheet.fill({area.left, area.top + row}, area.width, 1, colour(1 - (row + 0.5) / area.height));
  Plot plot(sheet, area, {0, 1, {}}, linear_axis(range.low, range.high));
  sheet.frame({area.left, area.top}, area.width, area.height);
  plot.second_axis(label);
}

/// The legend of colours that have a meaning each.
void draw_words(Sheet& sheet, double left, const std::string& label, const std::vector<std::string>& words) {
  const Area area{left + palette_area.left, palette_area.top, palette_area.width, palette_area.height};
  const auto count = static_cast<double>(words.size());
  Axis axis{0, count, {}};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const auto at = static_cast<double>(k);
    axis.ticks.push_back({at + 0.5, words[k], ""});
    sheet.fill({area.left, area.top + (count - 1 - at) / count * area.height}, area.width, area.height / count,
               colour(at / (count - 1)));
  }
  Plot plot(sheet, area, {0, 1, {}}, axis);
  sheet.frame({area.left, area.top}, area.width, area.height);
  plot.second_axis(label);
}

void draw_raster(Sheet& sheet, double left, const Panel& panel) {
  const bool numbers = panel.words.size() < 2;
  const ColourRange range =
      numbers ? colour_range(panel.patches) : ColourRange{0, static_cast<double>(panel.words.size() - 1)};
  const Raster raster = draw_patches(panel, range, raster_size);
  const int across = (raster_size - raster.width) / 2, down = (raster_size - raster.height) / 2;
  sheet.image({left + figure.left + across, figure.top + down}, raster);
  if (numbers)
    draw_palette(sheet, left, panel.label, range);
  else
    draw_words(sheet, left, panel.label, panel.words);
}

struct Style {
  Marker marker;
  Stroke stroke;
};
/// Of lines, one after the other.
Style style(std::size_t number) {
  constexpr std::array<std::array<int, 3>, 6> colours{{{0xb2, 0x18, 0x2b},
                                                       {0x21, 0x66, 0xac},
                                                       {0x1b, 0x78, 0x37},
                                                       {0x76, 0x2a, 0x83},
                                                       {0xe0, 0x82, 0x14},
                                                       {0x55, 0x55, 0x55}}};
  constexpr std::array<Marker, 3> markers{Marker::disk, Marker::square, Marker::circle};
  return {markers[number % markers.size()], {colours[number % colours.size()], 2}};
}
Style style(const std::vector<Line>& lines, std::size_t k) {
  Style out = style(lines[k].style < 0 ? k : static_cast<std::size_t>(lines[k].style));
  out.stroke.dashed = lines[k].dashed;
  return out;
}

/// What the lines with a name are, two in a row; the height of it.
double draw_key(Sheet& sheet, double left, double top, const std::vector<Line>& lines) {
  constexpr double between = 250, high = 20, length = 30;
  std::size_t shown = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].name.empty()) continue;
    const auto [marker, stroke] = style(lines, k);
    const std::size_t row = shown / 2, column = shown % 2;
    const Spot at{left + between * static_cast<double>(column), top + high * (0.5 + static_cast<double>(row))};
    if (lines[k].joined) sheet.line(at, {at.x + length, at.y}, stroke);
    if (lines[k].marked) sheet.mark({at.x + length / 2, at.y}, marker, stroke);
    sheet.text({at.x + length + 8, at.y}, lines[k].name, {0, 0.5});
    ++shown;
  }
  const std::size_t rows = (shown + 1) / 2;
  return high * static_cast<double>(rows);
}

/// With logarithms in place of numbers, which of what is not positive are no numbers.
std::vector<Line> logarithms(std::vector<Line> lines) {
  for (Line& line : lines)
    for (auto& point : line.points)
      for (double& x : point) x = x > 0 ? std::log10(x) : std::numeric_limits<double>::quiet_NaN();
  return lines;
}

/// What a panel shows of one direction.
struct Extent {
  double low = infinity, high = -infinity;

  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  /// Values that hardly differ are shown over zero.
  void reach_zero() {
    constexpr double one_value = 1e-3;  // relative
    if (high - low <= one_value * std::max(std::abs(low), std::abs(high))) add(0);
  }
};

void draw_lines(Sheet& sheet, double left, const Panel& panel) {
  const std::vector<Line> lines = panel.logarithmic ? logarithms(panel.lines) : panel.lines;
  Extent x, y;
  for (const Line& line : lines)
    for (const auto& point : line.points)
      if (std::isfinite(point[0]) && std::isfinite(point[1])) x.add(point[0]), y.add(point[1]);
  if (!(x.low <= x.high)) return;
  if (!panel.logarithmic) y.reach_zero();
  const auto axis = [&](const Extent& of) {
    return panel.logarithmic ? logarithmic_axis(of.low, of.high) : widened_axis(of.low, of.high);
  };
  const double key = draw_key(sheet, left + 110, 50, lines), top = 60 + key;
  Plot plot(sheet, {left + 110, top, raster_size, 500 - top}, axis(x), axis(y));
  if (panel.logarithmic) plot.grid();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto [marker, stroke] = style(lines, k);
    if (lines[k].joined)
      plot.curve(lines[k].points, lines[k].marked ? std::optional(marker) : std::nullopt, stroke);
    else
      plot.marks(lines[k].points, marker, stroke);
  }
  plot.x_axis(panel.across);
  plot.y_axis(panel.label);
}

}  // namespace

void draw_panels(const std::filesystem::path& picture, const std::vector<Panel>& panels) {
  Sheet sheet(panel_width * static_cast<int>(panels.size()), panel_height, picture);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const double left = panel_width * static_cast<double>(k);
    sheet.text({left + panel_width / 2.0, 30}, panels[k].title, {});
    if (panels[k].view == View::lines)
      draw_lines(sheet, left, panels[k]);
    else
      draw_raster(sheet, left, panels[k]);
  }
  sheet.write();
}

}  // namespace signorini
