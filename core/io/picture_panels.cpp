#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/io/picture.hpp"

namespace signorini {
namespace {
constexpr int panel_width = 800, panel_height = 700;
constexpr std::size_t edges_up_to = 6000;  ///< more triangles than this are drawn without their edges

/// gnuplot's text between single quotes, without its markup.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + result + "' noenhanced";
}

/// A pm3d surface per triangle: two scans of two points, of which the second is the third corner twice. pm3d averages
/// over the four, which would count that corner double.
std::string patch_data(const Panel& panel) {
  std::string text;
  const auto line = [&](const Patch& patch, int k) {
    const double* x = patch.corner[k];
    const double mean = (patch.value[0] + patch.value[1] + patch.value[2]) / 3;
    fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g} {:.7g}\n", x[0], x[1], x[2], mean);
  };
  for (const Patch& patch : panel.patches) {
    line(patch, 0);
    line(patch, 1);
    text += '\n';
    line(patch, 2);
    line(patch, 2);
    text += "\n\n";
  }
  return text;
}

std::string data(const Panel& panel) {
  if (panel.view != View::curve) return patch_data(panel);
  std::string text;
  for (const auto& [x, y] : panel.curve) text += fmt::format("{:.7g} {:.7g}\n", x, y);
  return text;
}

struct Box {
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  double low_value = infinity, high_value = -infinity;
};

Box bounding_box(const Panel& panel) {
  Box box;
  for (const Patch& patch : panel.patches)
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], patch.corner[c][k]);
        box.high[k] = std::max(box.high[k], patch.corner[c][k]);
      }
      box.low_value = std::min(box.low_value, patch.value[c]);
      box.high_value = std::max(box.high_value, patch.value[c]);
    }
  return box;
}

/// Axes and colours that are not empty: gnuplot refuses those.
std::string ranges(const Box& box) {
  std::string text;
  double widest = 0;
  for (int k = 0; k < 3; ++k) widest = std::max(widest, box.high[k] - box.low[k]);
  if (!(widest > 0)) widest = 1;
  for (int k = 0; k < 3; ++k) {
    const double middle = (box.low[k] + box.high[k]) / 2;
    const double half = std::max((box.high[k] - box.low[k]) / 2, 1e-3 * widest);
    text += fmt::format("set {}range [{}:{}]\n", "xyz"[k], middle - half, middle + half);
  }
  const double scale = std::max(std::abs(box.low_value), std::abs(box.high_value));
  const bool constant = !(box.high_value - box.low_value > 1e-6 * scale);
  const double margin = !constant ? 0 : scale > 0 ? 0.1 * scale : 1;
  return text + fmt::format("set cbrange [{}:{}]\n", box.low_value - margin, box.high_value + margin);
}

/// gnuplot turns about the vertical axis first, then about the horizontal one of the picture.
std::string angles(const double* from) {
  const double degrees = 180 / std::numbers::pi;
  const double tilt = std::acos(std::clamp(from[2], -1.0, 1.0)) * degrees;
  const double turn = std::fmod(std::atan2(from[0], -from[1]) * degrees + 360, 360.0);
  return fmt::format("{:.3f},{:.3f},1.1", tilt, turn);
}

std::string camera(const Panel& panel) {
  if (panel.view == View::flat) return "set view noequal_axes\nset view map\nset size ratio -1\n";
  return fmt::format("set size noratio\nset view equal {}\nset view {}\n", panel.view == View::space ? "xyz" : "xy",
                     panel.view == View::space ? angles(panel.from) : "50,30,1.2") +
         "set pm3d lighting primary 0.4 specular 0.05\n";
}

std::string plot_patches(const Panel& panel, const std::string& file) {
  const bool edges = panel.patches.size() <= edges_up_to;
  return fmt::format("set cblabel {}\n", quoted(panel.label)) + ranges(bounding_box(panel)) + camera(panel) +
         fmt::format("set pm3d {} corners2color mean {}\n", panel.view == View::flat ? "scansautomatic" : "depthorder",
                     edges ? "border lc '#606060' lw 0.3" : "noborder") +
         fmt::format("splot '{}' using 1:2:3:4 with pm3d\nset pm3d nolighting\n", file);
}

std::string plot_curve(const Panel& panel, const std::string& file) {
  return fmt::format(
      "set size square\nset border 3\nset xtics nomirror format '%.3g'\nset ytics nomirror\n"
      "set xrange [*:*]\nset yrange [*:*]\nset ylabel {}\n"
      "plot '{}' using 1:2 with linespoints lc '#b2182b' lw 2 pt 7 ps 0.4\n"
      "unset border\nunset xtics\nunset ytics\nunset ylabel\n",
      quoted(panel.label), file);
}

std::string plot(const Panel& panel, const std::string& file) {
  return fmt::format("set title {}\n", quoted(panel.title)) +
         (panel.view == View::curve ? plot_curve(panel, file) : plot_patches(panel, file));
}

constexpr const char* heading = R"(
unset key
unset border
unset xtics
unset ytics
unset ztics
set format cb '%.3g'
set palette defined (0 '#30123b', 1 '#4669db', 2 '#26bce1', 3 '#3ff58a', 4 '#a4fc3c', 5 '#ecd03a', 6 '#fb7e21', \
                     7 '#d02f05', 8 '#7a0403')
)";
}  // namespace

void draw_panels(Gnuplot& gnuplot, const std::filesystem::path& picture, const std::vector<Panel>& panels) {
  std::string script = heading + fmt::format("set multiplot layout 1,{}\n", panels.size());
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::string file = fmt::format("panel{}", k);
    gnuplot.add_data(file, data(panels[k]));
    script += plot(panels[k], file);
  }
  gnuplot.start(script + "unset multiplot\n", picture, panel_width * static_cast<int>(panels.size()), panel_height);
}

}  // namespace signorini
