#include "core/io/raster.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/dot.hpp"

namespace signorini {
namespace {

using Vector = std::array<double, 3>;
constexpr std::size_t edges_up_to = 1500;  ///< more triangles than this are drawn without their edges
constexpr double edge_width = 0.45;        ///< pixels on each side
constexpr std::array<int, 3> edge_colour{0x60, 0x60, 0x60};

Vector normalised(Vector a) {
  const double length = std::sqrt(dot(a, a));
  for (double& x : a) x = length > 0 ? x / length : 0;
  return a;
}

/// Extents along the axes.
struct Extent {
  Vector low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void add(const Vector& x) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  }
  double size(int k) const { return high[k] - low[k]; }
};

/// From space to the picture: right, up and towards the viewer, and where the light comes from. z is scaled first.
struct Camera {
  Vector right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1}, light{};
  double scale_z = 1;

  explicit Camera(const Panel& panel) {
    if (panel.view == View::flat) return;
    if (panel.view == View::graph) {
      towards = {0.383, -0.663, 0.643};
      scale_z = graph_scale(panel);
    } else {
      towards = {panel.from[0], panel.from[1], panel.from[2]};
    }
    towards = normalised(towards);
    const Vector across = cross({0, 0, 1}, towards);
    if (dot(across, across) > 1e-12) right = normalised(across);
    up = cross(towards, right);
    for (int k = 0; k < 3; ++k) light[k] = towards[k] + 0.6 * up[k] - 0.5 * right[k];
    light = normalised(light);
  }

  /// Half as high as wide.
  static double graph_scale(const Panel& panel) {
    Extent extent;
    for (const Patch& patch : panel.patches)
      for (const auto& x : patch.corner) extent.add({x[0], x[1], x[2]});
    return extent.size(2) > 0 ? 0.5 * std::max(extent.size(0), extent.size(1)) / extent.size(2) : 1;
  }

  Vector scaled(const double* x) const { return {x[0], x[1], scale_z * x[2]}; }
  Vector seen(const Vector& x) const { return {dot(right, x), dot(up, x), dot(towards, x)}; }
  double brightness(const Patch& patch) const {
    if (light == Vector{}) return 1;
    const Vector a = scaled(patch.corner[0]), b = scaled(patch.corner[1]), c = scaled(patch.corner[2]);
    const Vector u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return 0.62 + 0.38 * std::abs(dot(normalised(cross(u, v)), light));
  }
};

class Canvas {
 public:
  Canvas(const Panel& panel, const ColourRange& range, int size)
      : camera_(panel), range_(range), edges_(panel.patches.size() <= edges_up_to) {
    Extent extent;
    for (const Patch& patch : panel.patches)
      for (const auto& x : patch.corner) extent.add(camera_.seen(camera_.scaled(x)));
    const double widest = std::max(extent.size(0), extent.size(1));
    scale_ = widest > 0 ? size / widest : 1;
    origin_ = extent.low;
    const auto pixels = [&](int k) { return std::max(1, static_cast<int>(std::ceil(scale_ * extent.size(k) - 1e-9))); };
    raster_ = {pixels(0), pixels(1), {}};
    const std::size_t count = std::size_t(raster_.width) * raster_.height;
    raster_.rgb.assign(3 * count, '\xff');
    depth_.assign(count, -infinity);
  }

  void add(const Patch& patch) {
    std::array<Vector, 3> x;
    for (int c = 0; c < 3; ++c) {
      x[c] = camera_.seen(camera_.scaled(patch.corner[c]));
      for (int k = 0; k < 2; ++k) x[c][k] = scale_ * (x[c][k] - origin_[k]);
    }
    const auto [left, right] = std::minmax({x[0][0], x[1][0], x[2][0]});
    const auto [bottom, top] = std::minmax({x[0][1], x[1][1], x[2][1]});
    const int first_row = first(bottom), last_row = last(top, raster_.height);
    const int first_column = first(left), last_column = last(right, raster_.width);
    if (first_row > last_row || first_column > last_column) return;  // between the middles of pixels
    const double area = twice_area(x[0], x[1], x[2]);
    if (!(std::abs(area) > 0)) return;
    const Shape shape(patch, x, area, camera_.brightness(patch), edges_);
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column) set(shape, column, row);
  }

  Raster raster() && { return std::move(raster_); }

 private:
  /// A function that is linear on the raster.
  struct Linear {
    double at_corner = 0, along = 0, up = 0;  ///< at the patch's first corner, and by how much it grows

    double operator()(double x, double y) const { return at_corner + along * x + up * y; }
  };

  /// A patch on the raster. Its functions take places from the first corner on.
  struct Shape {
    double x, y;                     ///< of the first corner
    std::array<Linear, 3> weight;    ///< barycentric coordinates
    std::array<double, 3> height{};  ///< over the edges, where these are drawn
    Linear depth, value;
    double brightness;

    Shape(const Patch& patch, const std::array<Vector, 3>& corner, double area, double bright, bool edges)
        : x(corner[0][0]), y(corner[0][1]), brightness(bright) {
      for (int c = 0; c < 3; ++c) {
        const Vector &a = corner[(c + 1) % 3], &b = corner[(c + 2) % 3];
        weight[c] = {c == 0 ? 1.0 : 0.0, (a[1] - b[1]) / area, (b[0] - a[0]) / area};
        add(corner[c][2], weight[c], depth);
        add(patch.value[c], weight[c], value);
        if (edges) height[c] = std::abs(area) / length(a, b);
      }
    }

   private:
    static void add(double factor, const Linear& f, Linear& sum) {
      sum.at_corner += factor * f.at_corner;
      sum.along += factor * f.along;
      sum.up += factor * f.up;
    }
  };

  static double twice_area(const Vector& a, const Vector& b, const Vector& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  static double length(const Vector& a, const Vector& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

  // Pixels whose middle lies within.
  static int first(double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5 - 1e-9))); }
  static int last(double high, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(high - 0.5 + 1e-9)));
  }

  void set(const Shape& shape, int column, int row) {
    const double x = column + 0.5 - shape.x, y = row + 0.5 - shape.y;
    double nearest_edge = infinity;
    for (int c = 0; c < 3; ++c) {
      const double weight = shape.weight[c](x, y);
      if (weight < -1e-9) return;
      nearest_edge = std::min(nearest_edge, weight * shape.height[c]);
    }
    const double depth = shape.depth(x, y), value = shape.value(x, y);
    const std::size_t at = std::size_t(row) * raster_.width + column;
    if (!(depth > depth_[at]) || std::isnan(value)) return;
    depth_[at] = depth;
    const auto shade =
        edges_ && nearest_edge < edge_width ? edge_colour : colour((value - range_.low) / (range_.high - range_.low));
    for (int k = 0; k < 3; ++k)
      raster_.rgb[3 * at + k] = static_cast<char>(static_cast<int>(shape.brightness * shade[k]));
  }

  const Camera camera_;
  const ColourRange range_;
  const bool edges_;
  double scale_ = 1;
  Vector origin_{};
  Raster raster_;
  std::vector<double> depth_;  // of what each pixel shows
};

}  // namespace

std::array<int, 3> colour(double part) {
  constexpr int last = static_cast<int>(palette.size()) - 1;
  const double at = last * std::clamp(part, 0.0, 1.0);
  const int below = std::min(static_cast<int>(at), last - 1);
  std::array<int, 3> result;
  for (int k = 0; k < 3; ++k)
    result[k] = static_cast<int>(palette[below][k] + (at - below) * (palette[below + 1][k] - palette[below][k]) + 0.5);
  return result;
}

ColourRange colour_range(const std::vector<Patch>& patches) {
  ColourRange range{infinity, -infinity};
  for (const Patch& patch : patches)
    for (const double value : patch.value) range = {std::min(range.low, value), std::max(range.high, value)};
  const double scale = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low > 1e-6 * scale) return range;
  const double margin = scale > 0 ? 0.1 * scale : 1;
  return {range.low - margin, range.high + margin};
}

Raster draw_patches(const Panel& panel, const ColourRange& range, int size) {
  Canvas canvas(panel, range, size);
  for (const Patch& patch : panel.patches) canvas.add(patch);
  return std::move(canvas).raster();
}

}  // namespace signorini
