#include <fmt/format.h>

#include <cstddef>

#include "core/io/picture.hpp"
#include "core/io/raster.hpp"

namespace signorini {
namespace {
constexpr int panel_width = 640, panel_height = 560, raster_size = 450;

/// gnuplot's text between single quotes, without its markup.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + result + "' noenhanced";
}

std::string curve_data(const Panel& panel) {
  std::string text;
  for (const auto& [x, y] : panel.curve) text += fmt::format("{:.7g} {:.7g}\n", x, y);
  return text;
}

/// The colours come with the pixels; the second plot has nothing to show but the legend of the palette.
std::string plot_raster(const Panel& panel, const std::string& file, const Raster& raster, const ColourRange& range) {
  return fmt::format("set cblabel {}\nset cbrange [{}:{}]\nset size ratio -1\nset xrange [0:{}]\nset yrange [0:{}]\n",
                     quoted(panel.label), range.low, range.high, raster.width, raster.height) +
         fmt::format(
             "plot '{}' binary array=({},{}) format='%uchar' origin=(0.5,0.5) dx=1 dy=1 with rgbimage, \\\n"
             "     '+' using (NaN):(NaN):(0) with points palette\n",
             file, raster.width, raster.height);
}

std::string plot_curve(const Panel& panel, const std::string& file) {
  return fmt::format(
      "set size square\nset border 3\nset xtics nomirror format '%.3g'\nset ytics nomirror\n"
      "set xrange [*:*]\nset yrange [*:*]\nset ylabel {}\n"
      "plot '{}' using 1:2 with linespoints lc '#b2182b' lw 2 pt 7 ps 0.4\n"
      "unset border\nunset xtics\nunset ytics\nunset ylabel\n",
      quoted(panel.label), file);
}

std::string palette_definition() {
  std::string entries;
  for (std::size_t k = 0; k < palette.size(); ++k)
    entries += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", k ? ", " : "", k, palette[k][0], palette[k][1], palette[k][2]);
  return fmt::format("set palette defined ({})\n", entries);
}

/// Commands that draw the panel, whose data are added to `gnuplot` as `file`.
std::string plot(Gnuplot& gnuplot, const Panel& panel, const std::string& file) {
  const std::string title = fmt::format("set title {}\n", quoted(panel.title));
  if (panel.view == View::curve) {
    gnuplot.add_data(file, curve_data(panel));
    return title + plot_curve(panel, file);
  }
  const ColourRange range = colour_range(panel.patches);
  const Raster raster = draw_patches(panel, range, raster_size);
  gnuplot.add_data(file, raster.rgb);
  return title + plot_raster(panel, file, raster, range);
}

constexpr const char* heading = R"(
unset key
unset border
unset xtics
unset ytics
unset ztics
set format cb '%.3g'
)";
}  // namespace

void draw_panels(Gnuplot& gnuplot, const std::filesystem::path& picture, const std::vector<Panel>& panels) {
  std::string script = heading + palette_definition() + fmt::format("set multiplot layout 1,{}\n", panels.size());
  for (std::size_t k = 0; k < panels.size(); ++k) script += plot(gnuplot, panels[k], fmt::format("panel{}", k));
  gnuplot.start(script + "unset multiplot\n", picture, panel_width * static_cast<int>(panels.size()), panel_height);
}

}  // namespace signorini
