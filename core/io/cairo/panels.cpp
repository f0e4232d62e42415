#include <algorithm>

#include "core/io/cairo/painter.hpp"
#include "core/io/cairo/plot.hpp"
#include "core/io/raster.hpp"

namespace signorini {
namespace {
constexpr int panel_width = 640, panel_height = 560, raster_size = 450;
constexpr Area figure{30, 60, raster_size, raster_size};  // of a panel

/// The legend of the colours.
void draw_palette(Sheet& sheet, double left, const std::string& label, const ColourRange& range) {
  const Area area{left + 505, 85, 20, 400};
  for (int row = 0; row < area.height; ++row)
    sheet.fill({area.left, area.top + row}, area.width, 1, colour(1 - (row + 0.5) / area.height));
  Plot plot(sheet, area, {0, 1, {}}, linear_axis(range.low, range.high));
  sheet.frame({area.left, area.top}, area.width, area.height);
  plot.second_axis(label);
}

void draw_raster(Sheet& sheet, double left, const Panel& panel) {
  const ColourRange range = colour_range(panel.patches);
  const Raster raster = draw_patches(panel, range, raster_size);
  sheet.image({left + figure.left + (raster_size - raster.width) / 2, figure.top + (raster_size - raster.height) / 2},
              raster);
  draw_palette(sheet, left, panel.label, range);
}

void draw_curve(Sheet& sheet, double left, const Panel& panel) {
  std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity};
  for (const auto& point : panel.curve)
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], point[k]), high[k] = std::max(high[k], point[k]);
  Plot plot(sheet, {left + 110, 60, raster_size, raster_size - 10}, widened_axis(low[0], high[0]),
            widened_axis(low[1], high[1]));
  plot.curve(panel.curve, Marker::disk, {{0xb2, 0x18, 0x2b}, 2});
  plot.x_axis("");
  plot.y_axis(panel.label);
}

}  // namespace

void draw_panels(const std::filesystem::path& picture, const std::vector<Panel>& panels) {
  Sheet sheet(panel_width * static_cast<int>(panels.size()), panel_height);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const double left = panel_width * static_cast<double>(k);
    sheet.text({left + panel_width / 2.0, 30}, panels[k].title, {});
    if (panels[k].view == View::curve)
      draw_curve(sheet, left, panels[k]);
    else
      draw_raster(sheet, left, panels[k]);
  }
  sheet.write(picture);
}

}  // namespace signorini
